// SPDX-License-Identifier: BSD-3-Clause
// Untangling of meshes of quadrilaterals, and of these and triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/mixed_meshes.h"
#include "support/same_bits.h"

namespace trismooth::untangle_quadrilaterals_test {

using mixed_meshes::MixedMesh;
using mixed_meshes::shape_by_definition;
using Numbers = std::vector<double>;

constexpr std::array all_methods{Method::smart, Method::laplacian, Method::weighted, Method::mean_ratio};

/// The elements that are inverted, or have a corner in line.
std::int64_t inverted(const MixedMesh& mesh, const Numbers& xy) {
  std::int64_t count = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    count += shape_by_definition(mesh, e, xy) > 0 ? 0 : 1;
  }
  return count;
}

SmoothingOptions untangling(Method method = Method::smart) {
  SmoothingOptions options;
  options.untangle = Untangle::on;
  options.method = method;
  options.threads = 1;
  options.max_sweeps = 20;
  return options;
}

/// Every vertex on a side of one element alone, or of no element.
std::vector<bool> on_boundary(const MixedMesh& mesh) {
  std::multiset<std::pair<std::int32_t, std::int32_t>> sides;
  std::vector<bool> found(mesh.points.size(), true);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t next = corners[(i + 1) % corners.size()];
      sides.insert({std::min(corners[i], next), std::max(corners[i], next)});
      found[static_cast<std::size_t>(corners[i])] = false;
    }
  }
  for (const auto& side : sides) {
    if (sides.count(side) == 1) {
      found[static_cast<std::size_t>(side.first)] = true;
      found[static_cast<std::size_t>(side.second)] = true;
    }
  }
  return found;
}

/// A grid of `side` squares a side over the unit square, of which those are left whose middle is inside, laid out.
struct Domain {
  std::string_view name;
  std::function<bool(double, double)> is_inside;
  std::function<mixed_meshes::Point(double, double)> place;
};

std::vector<Domain> domains() {
  const auto everywhere = [](double, double) { return true; };
  const auto as_it_is = [](double u, double v) { return mixed_meshes::Point{u, v}; };
  return {{"square", everywhere, as_it_is},
          {"L", [](double u, double v) { return u < 0.5 || v < 0.5; }, as_it_is},
          {"comb", [](double u, double v) { return v < 0.3 || static_cast<int>(5 * u) % 2 == 0; }, as_it_is},
          {"hole", [](double u, double v) { return std::hypot(u - 0.4, v - 0.5) > 0.2; }, as_it_is},
          {"bow", everywhere, [](double u, double v) {
             return mixed_meshes::Point{(0.4 + v) * std::cos(4.5 * u), -(0.4 + v) * std::sin(4.5 * u)};
           }}};
}

MixedMesh mesh_of(const Domain& domain, std::int32_t side, std::uint64_t thirds) {
  MixedMesh mesh(side, side, 0.1, 3, thirds);
  std::erase_if(mesh.elements, [&](const mixed_meshes::Element& element) {
    const std::int32_t first = *std::min_element(element.begin(), element.begin() + 3);
    const double column = first % (side + 1) + 0.5;
    const double row = static_cast<double>(first / (side + 1)) + 0.5;
    return !domain.is_inside(column / side, row / side);
  });
  for (auto& point : mesh.points) {
    point = domain.place(point[0] / side, point[1] / side);
  }
  return mesh;
}

/// What is inside goes to one point, or anywhere in the bounding box.
MixedMesh tangled(const MixedMesh& mesh, bool to_one_point, std::uint64_t seed) {
  MixedMesh made = mesh;
  const std::vector<bool> stays = on_boundary(mesh);
  std::mt19937_64 random(seed);
  mixed_meshes::Point low = mesh.points.front();
  mixed_meshes::Point high = low;
  for (const auto& point : mesh.points) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  for (std::size_t v = 0; v < made.points.size(); ++v) {
    for (std::size_t axis = 0; axis < 2 && !stays[v]; ++axis) {
      std::uniform_real_distribution<double> anywhere(low[axis], high[axis]);
      made.points[v][axis] = to_one_point ? 0.5 * (low[axis] + high[axis]) : anywhere(random);
    }
  }
  return made;
}

TEST_CASE("quadrilaterals are untangled in domains of every shape, with and without triangles among them") {
  for (const Domain& domain : domains()) {
    for (const std::uint64_t thirds : {0U, 1U, 2U}) {
      for (const bool to_one_point : {true, false}) {
        CAPTURE(domain.name, thirds, to_one_point);
        const MixedMesh valid = mesh_of(domain, 16, thirds);
        REQUIRE(inverted(valid, valid.xy()) == 0);
        const MixedMesh mesh = tangled(valid, to_one_point, thirds + 5);
        const std::int64_t before = inverted(mesh, mesh.xy());
        CHECK(before > 30);
        const std::vector<bool> stays = on_boundary(mesh);
        for (const Method method : all_methods) {
          Numbers xy = mesh.xy();
          const SmoothingResult result = smooth(xy_points(xy), mesh.elements, untangling(method));
          CHECK(inverted(mesh, xy) == 0);
          CHECK(result.inverted + result.degenerate == 0);
          REQUIRE(result.untangling);
          CHECK(result.untangling->inverted_untangled == 0);
          for (std::size_t v = 0; v < stays.size(); ++v) {
            REQUIRE((!stays[v] ||
                     (same_bits(xy[2 * v], mesh.points[v][0]) && same_bits(xy[2 * v + 1], mesh.points[v][1]))));
          }
        }
      }
    }
  }
}

TEST_CASE("a grid whose points have been moved by up to 45 per cent has no inverted element left, by any method") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    MixedMesh mesh(100, 100, 0.45, 1, thirds);
    const std::vector<bool> stays = on_boundary(mesh);
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (stays[static_cast<std::size_t>(v)]) {
        mesh.points[static_cast<std::size_t>(v)] = {static_cast<double>(v % 101), static_cast<double>(v / 101)};
      }
    }
    const std::int64_t before = inverted(mesh, mesh.xy());
    CHECK(before > 250);
    for (const Method method : all_methods) {
      CAPTURE(thirds, to_string(method));
      Numbers xy = mesh.xy();
      const SmoothingResult result = smooth(xy_points(xy), mesh.elements, untangling(method));
      CHECK(result.untangling->inverted_before == before);
      CHECK(result.untangling->inverted_after == 0);
      CHECK(inverted(mesh, xy) == 0);
    }
  }
}

/// Some vertices far away, some held, some regions.
struct Case {
  MixedMesh mesh;
  std::vector<std::int32_t> regions;
  std::vector<std::int32_t> fixed;

  Constraints constraints() const {
    Constraints constraints;
    constraints.regions = regions;
    constraints.fixed_ids = fixed;
    return constraints;
  }
};

Case random_case(std::uint64_t seed) {
  Case made{mixed_meshes::random_mesh(seed), {}, {}};
  std::mt19937_64 random(seed + 1000);
  std::uniform_real_distribution<double> off(-2, 2);
  for (std::int32_t v = 0; v < made.mesh.vertex_count(); ++v) {
    auto& [x, y] = made.mesh.points[static_cast<std::size_t>(v)];
    if (seed % 3 != 0 && random() % 8 == 0) {
      x += off(random);
      y += off(random);
    }
    if (seed % 5 == 0 && random() % 8 == 0) {
      made.fixed.push_back(v);
    }
  }
  for (std::size_t e = 0; seed % 2 == 0 && e < made.mesh.elements.size(); ++e) {
    made.regions.push_back(random() % 8 == 0 ? 2 : 1);
  }
  return made;
}

TEST_CASE("untangled meshes have no element more inverted, none spoilt, and the same bits from all threads") {
  int mended = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const Case made = random_case(seed);
    const MixedMesh& mesh = made.mesh;
    const Numbers before = mesh.xy();
    SmoothingOptions options = untangling(all_methods[seed % 4]);
    options.form = seed % 3 == 0 ? Form::swap : Form::in_place;
    options.precision = seed % 7 == 0 ? Precision::single_precision : Precision::double_precision;
    Numbers after = before;
    const SmoothingResult result = smooth(xy_points(after), mesh.elements, made.constraints(), options);
    options.threads = 4;
    Numbers by_four = before;
    smooth(xy_points(by_four), mesh.elements, made.constraints(), options);
    REQUIRE(same_bits(after, by_four));
    REQUIRE(result.untangling);
    CHECK(result.untangling->inverted_after <= result.untangling->inverted_before);
    for (const std::int32_t v : made.fixed) {
      const auto i = 2 * static_cast<std::size_t>(v);
      REQUIRE((same_bits(after[i], before[i]) && same_bits(after[i + 1], before[i + 1])));
    }
    const std::int64_t were = inverted(mesh, before);
    if (2 * were >= std::ssize(mesh.elements)) {
      continue;  // which way they turn is what the majority says
    }
    CHECK(inverted(mesh, after) <= were);
    mended += inverted(mesh, after) < were ? 1 : 0;
    // The worst of the elements with a vertex that is elsewhere.
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const std::vector<std::int32_t> corners = mesh.corners(e);
      if (std::ranges::any_of(corners, [&](std::int32_t v) {
            const auto i = 2 * static_cast<std::size_t>(v);
            return after[i] != before[i] || after[i + 1] != before[i + 1];
          })) {
        worst = std::min(worst, shape_by_definition(mesh, e, before));
      }
    }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const double was = shape_by_definition(mesh, e, before);
      const double is = shape_by_definition(mesh, e, after);
      REQUIRE((was < 1e-12 || is > 0));
      REQUIRE((is >= worst - 1e-12 || is >= was - 1e-12));
    }
  }
  CHECK(mended > 100);
}

TEST_CASE("how elements are listed and numbered in which unit changes no bit of what is untangled") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const MixedMesh mesh = tangled(mesh_of(domains()[seed % 5], 9, seed % 3), seed % 2 == 0, seed);
    SmoothingOptions options = untangling(all_methods[seed % 4]);
    Numbers expected = mesh.xy();
    smooth(xy_points(expected), mesh.elements, options);
    CHECK_FALSE(same_bits(expected, mesh.xy()));
    for (const MixedMesh& listed : {mesh.in_another_order(seed), mesh.listed_from_other_corners(seed, false)}) {
      Numbers xy = mesh.xy();
      smooth(xy_points(xy), listed.elements, options);
      REQUIRE(same_bits(xy, expected));
    }
    for (const double scale : {0x1p-40, 0x1p30}) {
      Numbers xy = mesh.xy();
      std::ranges::transform(xy, xy.begin(), [&](double number) { return scale * number; });
      smooth(xy_points(xy), mesh.elements, options);
      std::ranges::transform(xy, xy.begin(), [&](double number) { return number / scale; });
      REQUIRE(same_bits(xy, expected));
    }
  }
}

TEST_CASE("a mesh in which most quadrilaterals are inverted is turned over first") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    for (const Method method : {Method::smart, Method::mean_ratio}) {
      CAPTURE(thirds, to_string(method));
      MixedMesh mesh(14, 14, 0.2, 8, thirds);
      const std::vector<bool> stays = on_boundary(mesh);
      for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        mesh.points[v][0] = stays[v] ? mesh.points[v][0] : 14 - mesh.points[v][0];
      }
      Numbers xy = mesh.xy();
      const SmoothingResult result = smooth(xy_points(xy), mesh.elements, untangling(method));
      CHECK(result.untangling->turned_components == 1);
      REQUIRE(result.untangling->turned.size() == mesh.elements.size());
      CHECK(std::ranges::count(result.untangling->turned, 1) == std::ssize(mesh.elements));
      CHECK(result.untangling->inverted_after == 0);
      CHECK(result.inverted == 0);
      CHECK(inverted(mesh, xy) == 0);
    }
  }
}

TEST_CASE("a corner of three held vertices that points inwards stays so, and all else is untangled") {
  MixedMesh mesh(12, 12, 0.2, 2, 0);
  const std::int32_t corner = 6 * 13 + 6;
  // The corner between two sides of the square up and to the right is beyond the diagonal of their ends.
  mesh.points[corner] = {6.8, 6.8};
  const std::vector<std::int32_t> held{corner, corner + 1, corner + 13};
  Constraints constraints;
  constraints.fixed_ids = held;
  mesh.points[corner - 3] = {7.5, 9};
  Numbers xy = mesh.xy();
  CHECK(inverted(mesh, xy) > 2);
  const SmoothingResult result = smooth(xy_points(xy), mesh.elements, constraints, untangling(Method::mean_ratio));
  CHECK(result.untangling->inverted_after == 1);
  CHECK(inverted(mesh, xy) == 1);
}

TEST_CASE("what is folded as a whole is untangled from few vertices on, and its quadrilaterals are convex") {
  const Domain bow = domains().back();
  for (const std::uint64_t thirds : {0U, 1U}) {
    CAPTURE(thirds);
    const MixedMesh mesh = tangled(mesh_of(bow, 70, thirds), true, 1);
    Numbers xy = mesh.xy();
    const SmoothingResult result = smooth(xy_points(xy), mesh.elements, untangling());
    CHECK(result.untangling->inverted_before > 2000);
    CHECK(inverted(mesh, xy) == 0);
  }
}

TEST_CASE("by itself the mean-ratio method untangles quadrilaterals, and no other one does") {
  const MixedMesh mesh = tangled(mesh_of(domains()[1], 10, 1), false, 4);
  for (const Method method : all_methods) {
    CAPTURE(to_string(method));
    SmoothingOptions options = untangling(method);
    options.untangle = Untangle::automatic;
    Numbers xy = mesh.xy();
    const SmoothingResult result = smooth(xy_points(xy), mesh.elements, options);
    CHECK(result.untangling.has_value() == (method == Method::mean_ratio));
    CHECK((method != Method::mean_ratio || inverted(mesh, xy) == 0));
    options.untangle = Untangle::off;
    CHECK_FALSE(smooth(xy_points(xy), mesh.elements, options).untangling);
  }
}

}  // namespace trismooth::untangle_quadrilaterals_test
