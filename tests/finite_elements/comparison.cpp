// SPDX-License-Identifier: BSD-3-Clause
#include "finite_elements/comparison.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/smoothing/options.h"

#include "catch.h"
#include "finite_elements/poisson.h"
#include "structured_meshes.h"
#include "support/scratch_folder.h"

namespace {

fem::Outcome solve(const fem::Mesh& mesh) {
  return fem::solve_poisson(mesh, fem::waves());
}

}  // namespace

TEST_CASE("smoothing makes both errors smaller and conjugate gradients faster") {
  const std::vector<fem::Row> rows = fem::compare(structured::displaced_square(40, 0.2), {"smart"}, solve);
  REQUIRE(rows.size() == 2);
  REQUIRE((rows[0].outcome && rows[1].outcome));
  CHECK(rows[0].name == "before");
  CHECK(rows[1].name == "smart");
  CHECK(rows[1].sweeps > 0);
  CHECK(rows[1].outcome->value_error < rows[0].outcome->value_error);
  CHECK(rows[1].outcome->gradient_error < rows[0].outcome->gradient_error);
  CHECK(rows[1].outcome->solution.plain < rows[0].outcome->solution.plain);
  CHECK(rows[1].outcome->solution.jacobi < rows[0].outcome->solution.jacobi);
}

TEST_CASE("where no method is named there is a row for each that the library has") {
  const auto& texts = trismooth::EnumText<trismooth::Method>::texts;
  const std::vector<fem::Row> rows = fem::compare(structured::displaced_square(8, 0.2), {}, solve);
  REQUIRE(rows.size() == texts.size() + 1);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    CHECK(rows[i + 1].name == texts[i].second);
  }
  CHECK_THROWS_AS(fem::compare(structured::square(2), {"smartest"}, solve), std::invalid_argument);
}

TEST_CASE("a mesh with inverted triangles has no solution before it is smoothed") {
  fem::Mesh mesh = structured::square(8);
  mesh.points.col(4 * 9 + 4) += Eigen::Vector2d(0.3, 0.05);
  const std::vector<fem::Row> rows = fem::compare(mesh, {"smart"}, solve);
  CHECK(rows[0].quality.inverted > 0);
  CHECK_FALSE(rows[0].outcome);
  CHECK(rows[1].quality.inverted == 0);
  CHECK(rows[1].outcome);
}

TEST_CASE("a file's triangles are read, its lines and unused points are not, and its regions hold the interface") {
  const ScratchFolder folder;
  const auto file = folder.write("mesh.vtk",
                                 "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                 "POINTS 6 double\n9 9 1  0 0 1  2 0 1  2 2 1  0 2 1  1.2 0.9 1\n"
                                 "CELLS 5 19\n2 1 2\n3 1 2 5\n3 2 3 5\n3 3 4 5\n3 4 1 5\nCELL_TYPES 5\n3 5 5 5 5\n"
                                 "CELL_DATA 5\nSCALARS region int 1\nLOOKUP_TABLE default\n7 1 1 2 2\n");
  const fem::Mesh mesh = fem::read(file.string());
  CHECK(mesh.points == (Eigen::Matrix2Xd(2, 5) << 0, 2, 2, 0, 1.2, 0, 0, 2, 2, 0.9).finished());
  CHECK(mesh.triangles == (Eigen::Matrix3Xi(3, 4) << 0, 1, 2, 3, 1, 2, 3, 0, 4, 4, 4, 4).finished());
  CHECK(mesh.regions == std::vector<std::int32_t>{1, 1, 2, 2});
  fem::Mesh smoothed = mesh;
  CHECK(smooth(smoothed, trismooth::Method::smart).moved_vertices == 0);
  smoothed.regions.clear();
  CHECK(smooth(smoothed, trismooth::Method::smart).moved_vertices == 1);
}

TEST_CASE("files are refused that hold other cells than triangles, none, or a mesh in space") {
  const ScratchFolder folder;
  const auto quad = folder.write("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const auto none = folder.write("none.off", "OFF\n1 0 0\n0 0 0\n");
  const auto space = folder.write("space.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1\n3 0 1 2\n");
  CHECK(message_of<std::runtime_error>([&] { fem::read(quad.string()); }) ==
        quad.string() + ": has a cell that is not a triangle");
  CHECK(message_of<std::runtime_error>([&] { fem::read(none.string()); }) == none.string() + ": has no triangles");
  CHECK(message_of<std::runtime_error>([&] { fem::read(space.string()); }) ==
        space.string() + ": does not lie in the plane of x and y");
}
