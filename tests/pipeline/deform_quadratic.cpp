// SPDX-License-Identifier: BSD-3-Clause
// trismooth deform of meshes with nodes in the middle of sides.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/scratch_folder.h"

namespace trismooth::deform_quadratic_test {

using namespace command_line_calls;

/// A square of four triangles of six nodes around vertex 4; middles 5 to 8 on the boundary, 9 to 12 inside.
MeshDocument quadratic_square() {
  MeshDocument document;
  document.points = {0, 0, 0, 2, 0, 0, 2, 2,   0,   0, 2,   0,   1, 1,   0,   1, 0,   0,   2, 1,
                     0, 1, 2, 0, 0, 1, 0, 0.5, 0.5, 0, 1.5, 0.5, 0, 1.5, 1.5, 0, 0.5, 1.5, 0};
  for (std::int32_t i = 0; i < 4; ++i) {
    document.cells.append(cell_type::quadratic_triangle, std::array{i, (i + 1) % 4, 4, 5 + i, 9 + (i + 1) % 4, 9 + i});
  }
  return document;
}

TEST_CASE("middles of curved boundaries go as they are told, those inside with their sides") {
  const ScratchFolder folder;
  MeshDocument document = quadratic_square();
  // The lower side bends down, all middles inside are told to go elsewhere.
  std::vector<double> motion(2 * 13, 0);
  motion[2 * 5 + 1] = -0.25;
  for (std::size_t v = 9; v < 13; ++v) {
    motion[2 * v] = 5;
  }
  document.point_arrays.push_back(make_data_array("d", 2, motion));
  write_mesh(folder / "in.vtu", document);
  const Outcome outcome = deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement", "d"});
  REQUIRE(outcome.code == 0);
  CHECK(outcome.says("the 4 displacements of vertices inside are not obeyed"));
  const std::vector<double> after = read_mesh(folder / "out.vtu").points;
  CHECK(after[3 * 5] == 1);
  CHECK(after[3 * 5 + 1] == -0.25);
  for (std::size_t v = 9; v < 13; ++v) {
    const std::size_t corner = v - 9;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      CHECK(after[3 * v + axis] == Approx((after[3 * corner + axis] + after[3 * 4 + axis]) / 2));
    }
  }
}

TEST_CASE("middles that nothing is said of go with their sides, and are not said to stay") {
  const ScratchFolder folder;
  write_mesh(folder / "in.vtu", quadratic_square());
  const std::string table = folder.write("corners.csv", "0 0 -1\n1 0 -1\n2 0 0\n3 0 0\n").string();
  const Outcome outcome =
      deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement-file", table});
  REQUIRE(outcome.code == 0);
  CHECK_FALSE(outcome.says("without a displacement"));
  const std::vector<double> after = read_mesh(folder / "out.vtu").points;
  CHECK(after[3 * 5 + 1] == -1);
  CHECK(after[3 * 6 + 1] == 0.5);
}

TEST_CASE("a middle on the boundary may be all that is told where to go") {
  const ScratchFolder folder;
  write_mesh(folder / "in.vtu", quadratic_square());
  const std::string table = folder.write("middle.csv", "5 0 -0.25\n").string();
  const Outcome outcome =
      deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement-file", table});
  REQUIRE(outcome.code == 0);
  CHECK(outcome.says("4 vertices that are held are without a displacement"));
  CHECK(read_mesh(folder / "out.vtu").points[3 * 5 + 1] == -0.25);
}

TEST_CASE("a step with a triangle of six nodes that is not valid is told, and is the worst") {
  const ScratchFolder folder;
  write_mesh(folder / "in.vtu", quadratic_square());
  const std::string corners = "0 0 0\n1 0 0\n2 0 0\n3 0 0\n";
  // A side that is pushed in by more than half of the triangle behind it, and a corner that is drawn out.
  const std::string pushed = folder.write("pushed.csv", corners + "5 0 0.6\n").string();
  const std::string drawn = folder.write("drawn.csv", "0 -5 0\n1 0 0\n2 0 0\n3 0 0\n").string();
  const Outcome outcome = deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--report",
                                  (folder / "run.json").string(), "--steps", drawn, pushed});
  CHECK(outcome.code == 0);
  CHECK(outcome.says("triangles of six nodes are not valid in 1 of 2 steps, it is step 2: 1 of 4 (0 before)"));
  const nlohmann::json report = nlohmann::json::parse(bytes_of(folder / "run.json"));
  CHECK(report["deformation"]["worst_step"] == 2);
  CHECK(report["deformation"]["steps"][0]["invalid_quadratic"] == 0);
  CHECK(report["deformation"]["steps"][1]["invalid_quadratic"] == 1);
  CHECK(report["after"]["quadratic"]["invalid"] == 1);
  CHECK(report["warnings"].size() == 1);
}

}  // namespace trismooth::deform_quadratic_test
