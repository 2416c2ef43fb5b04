// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/flat_points.h"

#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::describe_lost_z;
using trismooth::MeshDocument;
using trismooth::require_flat_points;
using trismooth::WriteError;

namespace {

MeshDocument with_heights(double first, double second, double third) {
  MeshDocument document;
  document.points = {0, 0, first, 4, 0, second, 0, 2, third};
  return document;
}

}  // namespace

TEST_CASE("flat points: z of 0 is nothing to speak of, whatever its sign") {
  for (const MeshDocument& document : {MeshDocument{}, with_heights(0, 0, 0), with_heights(0, -0.0, 0)}) {
    CHECK_NOTHROW(require_flat_points("mesh.su2", "SU2", document));
    CHECK(describe_lost_z("SU2", document).empty());
  }
}

TEST_CASE("flat points: a height of the whole mesh is lost with a sentence, and so is what rounding left of one") {
  CHECK_NOTHROW(require_flat_points("mesh.su2", "SU2", with_heights(2.5, 2.5, 2.5)));
  CHECK(describe_lost_z("SU2", with_heights(2.5, 2.5, 2.5)) ==
        std::vector<std::string>{"SU2 holds x and y only: z, 2.5, is not written"});
  CHECK_NOTHROW(require_flat_points("mesh.su2", "SU2", with_heights(0, 1e-17, -2e-9)));
  CHECK(describe_lost_z("SU2", with_heights(0, 1e-17, -2e-9)) ==
        std::vector<std::string>{"SU2 holds x and y only: z, from -2e-09 to 1e-17, is not written"});
}

TEST_CASE("flat points: a mesh in a tilted plane is refused, its heights are never dropped") {
  const std::string message =
      message_of<WriteError>([] { require_flat_points("mesh.su2", "SU2", with_heights(0, 0.5, 0)); });
  CHECK(message ==
        "mesh.su2: SU2 holds x and y only, and the mesh is in no plane of one z: it runs from 0 to 0.5; write a format "
        "with three coordinates, or turn the mesh first");
  CHECK_THROWS_AS(require_flat_points("mesh.su2", "SU2", with_heights(0, 5e-6, 0)), WriteError);
  CHECK_THROWS_AS(require_flat_points("mesh.su2", "SU2", with_heights(-1e308, 1e308, 0)), WriteError);
}
