// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/size_change.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::size_change_test {

using test_meshes::Mesh;
using test_meshes::triangles_of_areas;

TriangleView view_of(const Mesh& mesh) {
  return {mesh.points, mesh.triangles, {}, 0};
}

bool same(const SizeChange& a, const SizeChange& b) {
  return a.triangles == b.triangles && a.left_out == b.left_out && same_bits(a.rms_log_ratio, b.rms_log_ratio) &&
         same_bits(a.ratio_p1, b.ratio_p1) && same_bits(a.ratio_p99, b.ratio_p99);
}

double doubled_area(const Mesh& mesh, const Triangle& t) {
  const auto [a, b, c] = t;
  return cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
}

TEST_CASE("sizes of a mesh that stayed have not changed, to the bit") {
  const Mesh mesh = test_meshes::jittered_grid(9, 9, 0.3, 1);
  CHECK(same(size_change(view_of(mesh), view_of(mesh)), {128, 0, 0, 1, 1}));
}

TEST_CASE("the change of sizes is the root mean square of the logarithms, and as far up as down") {
  const SizeChange change =
      size_change(view_of(triangles_of_areas({1, 1, 4, 4})), view_of(triangles_of_areas({2, 0.5, 4, 4})));
  CHECK(change.triangles == 4);
  CHECK(change.left_out == 0);
  CHECK(change.rms_log_ratio == Approx(std::log(2) / std::sqrt(2)).epsilon(1e-14));
  CHECK(change.ratio_p1 == 0.5);
  CHECK(change.ratio_p99 == 2);
}

TEST_CASE("percentiles of sizes are the values that 1 and 99 of a hundred do not exceed") {
  const int hundreds = GENERATE(1, 2, 70);
  test_meshes::Random random(2);
  std::vector<double> before;
  std::vector<double> after;
  for (int i = 0; i < 100 * hundreds; ++i) {
    before.push_back(std::ldexp(1, random.below(8) - 4));
    after.push_back(before.back() * (1 + i));
  }
  const SizeChange change = size_change(view_of(triangles_of_areas(before)), view_of(triangles_of_areas(after)));
  CHECK(change.ratio_p1 == hundreds);
  CHECK(change.ratio_p99 == 99 * hundreds);
}

TEST_CASE("percentiles of sizes are exact where nearly all sizes are as they were") {
  // Steps of one unit in the last place of the ratio; of 0: all are equal.
  const double step = GENERATE(0, 0x1p-52, 0x1p-40, 0x1p-30);
  const int threads = GENERATE(1, 3);
  CAPTURE(step, threads);
  constexpr int hundreds = 4000;
  std::vector<double> after(std::size_t{100} * hundreds);
  for (std::size_t i = 0; i < after.size(); ++i) {
    after[i] = 1 + step * static_cast<double>(i * 7919 % after.size());  // every i once
  }
  const SizeChange change = size_change(view_of(triangles_of_areas(std::vector<double>(after.size(), 1))),
                                        view_of(triangles_of_areas(after)), threads);
  CHECK(change.ratio_p1 == 1 + step * (hundreds - 1));
  CHECK(change.ratio_p99 == 1 + step * (99 * hundreds - 1));
}

TEST_CASE("triangles that are inverted or degenerate on one side are left out of the change of sizes") {
  const SizeChange change = size_change(view_of(triangles_of_areas({1, -1, 0, 1, 1, -1, 0})),
                                        view_of(triangles_of_areas({3, 1, 1, -1, 0, -1, 0})));
  CHECK(change.triangles == 1);
  CHECK(change.left_out == 6);
  CHECK(change.rms_log_ratio == Approx(std::log(3)).epsilon(1e-14));
  CHECK(change.ratio_p1 == 3);
  CHECK(change.ratio_p99 == 3);

  const SizeChange none = size_change(view_of(triangles_of_areas({-1})), view_of(triangles_of_areas({1})));
  CHECK(none.triangles == 0);
  CHECK(none.left_out == 1);
  for (const double value : {none.rms_log_ratio, none.ratio_p1, none.ratio_p99}) {
    CHECK(std::isnan(value));
  }
}

TEST_CASE("the change of sizes knows triangles that are listed clockwise, and frames of different scale") {
  Mesh before = triangles_of_areas({1, 2});
  Mesh after = triangles_of_areas({2, 4});
  std::swap(before.triangles[1][0], before.triangles[1][2]);
  after.triangles = before.triangles;
  const std::vector<std::uint8_t> reversed{0, 1};
  const SizeChange change =
      size_change({before.points, before.triangles, reversed, 3}, {after.points, after.triangles, reversed, 2});
  CHECK(change.left_out == 0);
  CHECK(change.ratio_p1 == 0.5);
  CHECK(change.ratio_p99 == 0.5);
}

TEST_CASE("the change of sizes agrees with a plain evaluation, to the same bits for every number of threads") {
  const Mesh before = test_meshes::tangled(120, 3);
  Mesh after = test_meshes::jittered_grid(120, 120, 0.4, 4);
  after.triangles = before.triangles;
  std::vector<double> ratios;
  long double sum = 0;
  for (const Triangle& t : before.triangles) {
    const double from = doubled_area(before, t);
    const double to = doubled_area(after, t);
    if (from > 0 && to > 0) {
      ratios.push_back(to / from);
      sum += std::pow(std::log(static_cast<long double>(to) / from), 2);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double part) {
    return ratios[static_cast<std::size_t>(std::ceil(part * static_cast<double>(ratios.size()))) - 1];
  };

  const SizeChange change = size_change(view_of(before), view_of(after), 1);
  CHECK(change.triangles == static_cast<std::int64_t>(ratios.size()));
  CHECK(change.left_out == static_cast<std::int64_t>(before.triangles.size() - ratios.size()));
  CHECK(change.left_out > 0);
  CHECK(change.rms_log_ratio ==
        Approx(static_cast<double>(std::sqrt(sum / static_cast<long double>(ratios.size())))).epsilon(1e-12));
  CHECK(change.ratio_p1 == Approx(at(0.01)).epsilon(1e-12));
  CHECK(change.ratio_p99 == Approx(at(0.99)).epsilon(1e-12));
  for (const int threads : {2, 3, 5}) {
    CHECK(same(size_change(view_of(before), view_of(after), threads), change));
  }
}

TEST_CASE("the change of sizes is of one list of triangles") {
  CHECK_THROWS_AS(size_change(view_of(triangles_of_areas({1, 2})), view_of(triangles_of_areas({1}))),
                  std::invalid_argument);
}

}  // namespace trismooth::size_change_test
