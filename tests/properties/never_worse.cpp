// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "trismooth/smoothing/keep_never_worse.h"

#include "catch.h"
#include "properties/contract.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

TEST_CASE("no element gets worse, nothing moves that is held, every coordinate is finite, every count is true") {
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    const Connectivity connectivity = connectivity_of(mesh);
    return for_some_options(mesh, 6, [&](SmoothingOptions options, test_meshes::Random& random) {
      options.guard = random.below(5) != 0;
      const Storage storage = fits_float32(mesh) && random.below(3) == 0 ? Storage::float32 : Storage::float64;
      return breach(mesh, connectivity, run(mesh, options, storage), options.guard);
    });
  });
}

TEST_CASE(
    "of moves that something else has made those go back that make an element worse, and those of held vertices") {
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    if (!fits_float32(mesh)) {
      return std::string();  // what is judged here could leave the range of double
    }
    const Connectivity connectivity = connectivity_of(mesh);
    const std::vector<double> before = mesh.mesh.xy();
    test_meshes::Random random = draws_for(mesh);
    Run made{before, {}};
    for (const trismooth::Triangle& t : mesh.mesh.triangles) {
      const auto from = static_cast<std::size_t>(t[0]);
      const auto to = static_cast<std::size_t>(t[1]);
      const double part = random.below(3) == 0 ? 0 : random.between(-0.3, random.below(4) == 0 ? 1 : 0.4);
      for (const std::size_t axis : {0U, 1U}) {
        made.xy[2 * from + axis] = before[2 * from + axis] * (1 - part) + before[2 * to + axis] * part;
      }
    }
    std::int64_t held = 0;
    for (std::size_t v = 0; v < mesh.mesh.points.size(); ++v) {
      const bool moves = made.xy[2 * v] != before[2 * v] || made.xy[2 * v + 1] != before[2 * v + 1];
      held += moves && connectivity.fixed[v] ? 1 : 0;
    }
    const trismooth::KeptMoves kept = keep_never_worse(trismooth::xy_points(before), trismooth::xy_points(made.xy),
                                                       mesh.mesh.indices(), mesh.constraints());
    if (std::ssize(kept.held) != held) {
      return fmt::format("{} vertices that are held had moved, not {}", held, kept.held.size());
    }
    made.result.moved_vertices = kept.moved_vertices;
    made.result.reverted = kept.reverted;
    made.result.reverted_vertices = std::ssize(kept.reverted);
    made.result.free_vertices = std::ranges::count(connectivity.fixed, false);
    return breach(mesh, connectivity, made, true);
  });
}
