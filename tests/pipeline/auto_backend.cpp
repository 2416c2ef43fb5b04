// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/auto_backend.h"

#include "trismooth/smoothing/cpu_backend.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::auto_backend_test {

TEST_CASE("the backend that chooses by itself smooths a small mesh on the CPU, in every build") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(12, 12, 0.45, 3);
  trismooth::SmoothingOptions options;
  std::vector<double> expected = mesh.xy();
  trismooth::smooth(trismooth::xy_points(expected), mesh.indices(), {}, options);

  options.backend = &trismooth::auto_backend();
  CHECK(options.backend == &trismooth::auto_backend());
  CHECK(options.backend->name() == "auto");
  std::vector<double> xy = mesh.xy();
  const trismooth::SmoothingResult result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
  CHECK(result.backend == "cpu");
  CHECK(result.backend_note.empty());
  CHECK(xy == expected);
}

}  // namespace trismooth::auto_backend_test
