// SPDX-License-Identifier: BSD-3-Clause
// What holds of layers put into meshes: their heights.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "support/layered_meshes.h"

namespace layers_test {

using test_meshes::Mesh;
using test_meshes::Random;
using trismooth::Method;

/// The least and the largest height of each row of the layer, above a wall that is y = 0 in both.
double largest_change(const Mesh& mesh, std::span<const double> xy, std::int32_t columns, std::size_t rows) {
  double change = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = row * static_cast<std::size_t>(columns); i < (row + 1) * static_cast<std::size_t>(columns);
         ++i) {
      const std::size_t above = i + static_cast<std::size_t>(columns);
      const double before = mesh.points[above].y - mesh.points[i].y;
      change = std::max(change, std::abs((xy[2 * above + 1] - xy[2 * i + 1]) / before - 1));
    }
  }
  return change;
}

TEST_CASE("no layer's height changes by more than 5 per cent under any method's default") {
  constexpr auto methods = trismooth::values_of<Method>();
  const std::int64_t count = properties::meshes_of(3000);
  std::int64_t moved = 0;
  for (std::int64_t seed = 0; seed < count; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    layered_meshes::Layers layers;
    layers.columns = 14 + random.below(40);
    layers.rows_above = 2 + random.below(12);
    layers.jitter = random.between(0, 0.45);
    layers.heights =
        layered_meshes::growing(std::pow(10.0, random.between(-4, -0.7)), random.between(1, 1.6), 1 + random.below(20));
    const Mesh mesh = layered_meshes::rectangle(layers, random);
    std::vector<double> xy = mesh.xy();
    trismooth::SmoothingOptions options;
    options.method = methods[static_cast<std::size_t>(random.below(methods.size()))];
    options.form = random.below(2) == 0 ? trismooth::Form::in_place : trismooth::Form::swap;
    moved += trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), options).moved_vertices > 0 ? 1 : 0;
    INFO("mesh " << seed << ", " << layers.columns << " columns, " << layers.heights.size() << " rows from "
                 << layers.heights.front() << ", " << to_string(options.method));
    REQUIRE(largest_change(mesh, xy, layers.columns, layers.heights.size()) <= 0.05);
  }
  CHECK(moved >= count * 9 / 10);
}

}  // namespace layers_test
