// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/size_fit.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::size_fit_test {

using test_meshes::Mesh;
using test_meshes::triangles_of_areas;

TriangleView view_of(const Mesh& mesh) {
  return {mesh.points, mesh.triangles, {}, 0};
}

TEST_CASE("sizes fit where they are those asked for but for a factor") {
  const Mesh mesh = triangles_of_areas({1, 2, 5});
  const std::vector<double> asked{1, 1, 1, 0.5, 0.5, 0.5, 0.3, 0.1, 0.2};
  const SizeFit fit = size_fit(view_of(mesh), asked, std::vector<std::uint8_t>(9, 0));
  CHECK(fit.elements == 3);
  CHECK(fit.left_out == 0);
  CHECK(fit.rms_log_ratio < 1e-14);
}

TEST_CASE("how far sizes are off is the root mean square of the logarithms, with the same area asked for as there is") {
  const Mesh mesh = triangles_of_areas({1, 3});
  // 2 and 2 are asked for.
  const SizeFit fit = size_fit(view_of(mesh), std::vector<double>(6, 0.01), std::vector<std::uint8_t>(6, 0));
  const double down = std::log(1.0 / 2);
  const double up = std::log(3.0 / 2);
  CHECK(fit.rms_log_ratio == Approx(std::sqrt((down * down + up * up) / 2)).epsilon(1e-14));
}

TEST_CASE("triangles that are held or not valid are left out") {
  const Mesh mesh = triangles_of_areas({1, -1, 3, 0, 100});
  std::vector<std::uint8_t> held(15, 0);
  held[12] = held[13] = held[14] = 1;  // the last one
  held[0] = held[1] = 64;              // the first one keeps a corner
  const SizeFit fit = size_fit(view_of(mesh), std::vector<double>(15, 1), held);
  CHECK(fit.elements == 2);
  CHECK(fit.left_out == 2);
  CHECK(fit.rms_log_ratio ==
        Approx(size_fit(view_of(triangles_of_areas({1, 3})), std::vector<double>(6, 1), std::vector<std::uint8_t>(6, 0))
                   .rms_log_ratio));
  const SizeFit none = size_fit(view_of(mesh), std::vector<double>(15, 1), std::vector<std::uint8_t>(15, 1));
  CHECK(none.elements == 0);
  CHECK(std::isnan(none.rms_log_ratio));
}

TEST_CASE("how far sizes are off does not depend on the number of threads") {
  const Mesh mesh = test_meshes::jittered_grid(90, 90, 0.3, 1);
  std::vector<double> asked;
  for (const auto p : mesh.points) {
    asked.push_back(1 / (1 + p.x * p.x));
  }
  const std::vector<std::uint8_t> held(asked.size(), 0);
  const SizeFit expected = size_fit(view_of(mesh), asked, held, 1);
  for (const int threads : {2, 3, 7}) {
    CHECK(same_bits(size_fit(view_of(mesh), asked, held, threads).rms_log_ratio, expected.rms_log_ratio));
  }
}

}  // namespace trismooth::size_fit_test
