// SPDX-License-Identifier: BSD-3-Clause
// What smooth() and plans refuse, and leave untouched.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/same_bits.h"
#include "support/test_meshes.h"

namespace trismooth::smooth_refused_test {

using test_meshes::Mesh;

/// A copy to change.
std::vector<std::int32_t> index_list(const Mesh& mesh) {
  const auto indices = mesh.indices();
  return {indices.begin(), indices.end()};
}

TEST_CASE("coordinates that are not finite are refused, and xy is untouched") {
  const Mesh mesh = test_meshes::star(5);
  SmoothingPlan repeated = plan(mesh.vertex_count(), mesh.indices());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (const std::size_t place : {0U, 1U, 6U, 11U}) {
      std::vector<double> xy = mesh.xy();
      xy[place] = bad;
      const std::vector<double> before = xy;
      const std::string message = "vertex " + std::to_string(place / 2) + " has a coordinate that is not finite";
      CHECK_THROWS_AS(repeated.smooth(xy), MeshError);
      CHECK_THROWS_WITH(repeated.smooth(xy), message);
      CHECK_THROWS_WITH(smooth(xy_points(xy), mesh.indices()), message);
      CHECK(same_bits(xy, before));
    }
  }
  // The plan is as good as before.
  std::vector<double> xy = mesh.xy();
  repeated.smooth(xy);
  std::vector<double> expected = mesh.xy();
  smooth(xy_points(expected), mesh.indices());
  CHECK(xy == expected);
}

TEST_CASE("arrays of the wrong length are refused, and xy is untouched") {
  const Mesh mesh = test_meshes::star(5);
  SmoothingPlan repeated = plan(mesh.vertex_count(), mesh.indices());
  for (const std::size_t length : {0U, 10U, 11U, 13U, 14U}) {
    std::vector<double> xy(length, 0.25);
    CHECK_THROWS_AS(repeated.smooth(xy), std::invalid_argument);
    CHECK(xy == std::vector<double>(length, 0.25));
  }
  std::vector<double> odd = mesh.xy();
  odd.push_back(0);
  const std::vector<double> before = odd;
  CHECK_THROWS_AS(smooth(xy_points(odd), mesh.indices()), std::invalid_argument);
  std::vector<std::int32_t> indices = index_list(mesh);
  indices.pop_back();
  std::vector<double> xy = mesh.xy();
  CHECK_THROWS_AS(smooth(xy_points(xy), indices), std::invalid_argument);
  CHECK_THROWS_AS(plan(mesh.vertex_count(), indices), std::invalid_argument);
  CHECK(odd == before);
  CHECK(xy == mesh.xy());
}

TEST_CASE("triangles that are no mesh, constraints and options that do not fit are refused, and xy is untouched") {
  const Mesh mesh = test_meshes::star(5);
  std::vector<double> xy = mesh.xy();
  const auto refuses_triangle = [&](std::vector<std::int32_t> more) {
    std::vector<std::int32_t> indices = index_list(mesh);
    indices.insert(indices.end(), more.begin(), more.end());
    CHECK_THROWS_AS(smooth(xy_points(xy), indices), MeshError);
  };
  refuses_triangle({0, 1, 6});
  refuses_triangle({0, -1, 2});
  refuses_triangle({2, 2, 3});
  const std::vector<std::int32_t> ids{6};
  Constraints constraints;
  constraints.fixed_ids = ids;
  CHECK_THROWS_AS(smooth(xy_points(xy), mesh.indices(), constraints), std::invalid_argument);
  SmoothingOptions options;
  options.tolerance = -1;
  CHECK_THROWS_AS(smooth(xy_points(xy), mesh.indices(), {}, options), std::invalid_argument);
  CHECK(xy == mesh.xy());
  std::vector<double> band = test_meshes::moebius_band(5).xy();
  CHECK_THROWS_AS(smooth(xy_points(band), test_meshes::moebius_band(5).indices()), MeshError);
}

TEST_CASE("more threads than a machine can have are refused before any is started, by every call that takes a number") {
  const Mesh mesh = test_meshes::star(5);
  std::vector<double> xy = mesh.xy();
  SmoothingOptions options;
  for (const int threads : {100000, std::numeric_limits<int>::max(), -1}) {
    options.threads = threads;
    CHECK_THROWS_AS(smooth(xy_points(xy), mesh.indices(), {}, options), std::invalid_argument);
    CHECK_THROWS_AS(plan(mesh.vertex_count(), mesh.indices(), {}, options), std::invalid_argument);
  }
  CHECK(xy == mesh.xy());
}

TEST_CASE("arrays of more vertices or triangles than 32 bits number are refused before anybody looks at them") {
  // No memory is behind all of these numbers.
  double coordinate = 0;
  std::int32_t index = 0;
  constexpr std::size_t vertices = std::size_t{1} << 31U;
  constexpr std::size_t triangles = 715827883;
  for (const std::size_t wrapped_around : {vertices, 2 * vertices, 2 * vertices + 3}) {
    CHECK_THROWS_AS(smooth(xy_points(std::span(&coordinate, 2 * wrapped_around)), std::span<const std::int32_t>{}),
                    MeshError);
  }
  for (const std::size_t wrapped_around : {triangles, 2 * vertices, 2 * vertices + 1}) {
    CHECK_THROWS_AS(smooth(xy_points(std::span(&coordinate, 2)), std::span(&index, 3 * wrapped_around)), MeshError);
    CHECK_THROWS_AS(plan(3, std::span(&index, 3 * wrapped_around)), MeshError);
  }
}

}  // namespace trismooth::smooth_refused_test
