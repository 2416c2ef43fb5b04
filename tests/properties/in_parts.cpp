// SPDX-License-Identifier: BSD-3-Clause
// A mesh that is smoothed in parts by threads of one process comes out as one that is not.

#include "properties/in_parts.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "catch.h"
#include "properties/for_random_meshes.h"
#include "properties/smoothing_cases.h"

using namespace properties;

TEST_CASE("parts of a mesh that threads smooth have the bits and figures of the whole") {
  for_random_meshes(2000, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 2, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      std::vector<double> lengths;
      draw_for_parts(mesh, options, lengths, random);
      const Storage storage = fits_float32(mesh) && random.below(4) == 0 ? Storage::float32 : Storage::float64;
      const int parts = 1 + random.below(random.below(40) == 0 ? 40 : 5);
      constexpr bool untangles = false;
      const std::string wrong = difference_in_parts(mesh, options, storage, PartsBackend(parts), untangles);
      return wrong.empty() ? wrong : fmt::format("{} parts: {}", parts, wrong);
    });
  });
}

TEST_CASE("an exception of a progress callback leaves a mesh in parts as it was, and its plan as good as new") {
  for_random_meshes(300, [](const RandomMesh& mesh) {
    return for_some_options(mesh, 1, [&](SmoothingOptions options, test_meshes::Random& random) -> std::string {
      options.untangle = trismooth::Untangle::off;
      const Run expected = run(mesh, options);
      const PartsBackend backend(1 + random.below(5));
      options.backend = &backend;
      bool throws = true;
      options.progress = [&throws](const trismooth::SweepRecord&) -> trismooth::Progress {
        if (throws) {
          throw std::runtime_error("no more");
        }
        return trismooth::Progress::proceed;
      };
      auto plan = trismooth::plan(mesh.mesh.vertex_count(), mesh.mesh.indices(), mesh.constraints(), options);
      Run found{mesh.mesh.xy(), {}};
      try {
        plan.smooth(found.xy);
        if (expected.result.sweeps > 0) {
          return "nobody was told";
        }
      } catch (const std::runtime_error& error) {
        if (std::string(error.what()) != "no more") {
          return error.what();
        }
      }
      if (const std::string moved = difference(found.xy, mesh.mesh.xy());
          !moved.empty() && expected.result.sweeps > 0) {
        return "thrown, and moved: " + moved;
      }
      throws = false;
      found.xy = mesh.mesh.xy();
      found.result = plan.smooth(found.xy);
      return difference(found, expected);
    });
  });
}
