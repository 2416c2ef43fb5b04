// SPDX-License-Identifier: BSD-3-Clause
#include "properties/with_unused.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace properties {

namespace {

/// From the smallest to the largest magnitude, many of them where squares overflow.
double anywhere(test_meshes::Random& random) {
  const double sign = random.below(2) == 0 ? 1 : -1;
  switch (random.below(4)) {
    case 0:
      return sign * std::pow(10.0, random.between(-300, 300));
    case 1:
      return sign * std::pow(10.0, random.between(150, 165));
    case 2:
      return sign * std::numeric_limits<double>::max();
    default:
      return sign * std::pow(10.0, random.between(0, 20));
  }
}

}  // namespace

bool WithUnused::is_old(std::int32_t vertex) const {
  return std::ranges::binary_search(number, vertex);
}

Run WithUnused::without(const Run& run) const {
  Run old{{}, run.result};
  for (const std::int32_t v : number) {
    old.xy.insert(old.xy.end(), {run.xy[2 * v], run.xy[2 * v + 1]});
  }
  for (auto& reverted : old.result.reverted) {
    reverted.vertex = static_cast<std::int32_t>(std::ranges::find(number, reverted.vertex) - number.begin());
  }
  return old;
}

WithUnused with_unused_vertices(const RandomMesh& mesh, bool at_the_end, test_meshes::Random& random) {
  WithUnused result;
  RandomMesh& more = result.mesh;
  more.seed = mesh.seed;
  more.kind = mesh.kind + ", unused vertices";
  more.regions = mesh.regions;
  const auto add_one = [&] {
    const bool is_near = mesh.mesh.vertex_count() > 0 && random.below(4) == 0;
    const double x = anywhere(random);
    more.mesh.points.push_back(is_near
                                   ? mesh.mesh.points[static_cast<std::size_t>(random.below(mesh.mesh.vertex_count()))]
                                   : test_meshes::Point{x, anywhere(random)});
    more.fixed.push_back(static_cast<std::uint8_t>(random.below(2)));
    more.other_cells.push_back(0);
  };
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    while (!at_the_end && random.below(3) == 0) {
      add_one();
    }
    result.number.push_back(more.mesh.vertex_count());
    more.mesh.points.push_back(mesh.mesh.points[v]);
    more.fixed.push_back(mesh.fixed.empty() ? 0 : mesh.fixed[v]);
    more.other_cells.push_back(mesh.other_cells.empty() ? 0 : mesh.other_cells[v]);
  }
  for (std::int32_t i = 1 + random.below(5); i > 0; --i) {
    add_one();
  }
  for (const std::int32_t v : mesh.fixed_ids) {
    more.fixed_ids.push_back(result.number[v]);
  }
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    more.mesh.triangles.push_back({result.number[a], result.number[b], result.number[c]});
  }
  return result;
}

}  // namespace properties
