// SPDX-License-Identifier: BSD-3-Clause
// Vertices that no cell uses keep their bits, and have no say in anything.

#include <cstdint>
#include <string>

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"
#include "properties/with_unused.h"
#include "support/same_bits.h"

using namespace properties;

TEST_CASE("unused vertices, however far, keep their bits and change none: of Form B, unless they change numbers") {
  for_random_meshes(3000, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.record_min_shape = random.below(2) == 0;
      const bool at_the_end = random.below(2) == 0;
      const Storage storage = fits_float32(mesh) && random.below(3) == 0 ? Storage::float32 : Storage::float64;
      const WithUnused more = with_unused_vertices(mesh, at_the_end, random);
      const Run with_more = run(more.mesh, options, storage);
      for (std::int32_t v = 0; v < more.mesh.mesh.vertex_count(); ++v) {
        const auto [x, y] = more.mesh.mesh.points[v];
        if (!more.is_old(v) && !(same_bits(with_more.xy[2 * v], x) && same_bits(with_more.xy[2 * v + 1], y))) {
          return fmt::format("unused vertex {} moved", v);
        }
      }
      if (options.form != Form::in_place || at_the_end) {
        return difference(more.without(with_more), run(mesh, options, storage));
      }
      // Colours go by number. With the same numbers it does not matter where the unused ones are.
      RandomMesh at_one_place = more.mesh;
      for (std::int32_t v = 0; v < at_one_place.mesh.vertex_count(); ++v) {
        if (!more.is_old(v)) {
          at_one_place.mesh.points[v] = mesh.mesh.points.empty() ? test_meshes::Point{} : mesh.mesh.points.front();
        }
      }
      return difference(more.without(with_more), more.without(run(at_one_place, options, storage)));
    });
  });
}
