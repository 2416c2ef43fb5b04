#include "trismooth/pipeline/input/repeated_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/says.h"
#include "support/test_meshes.h"

using trismooth::MeshDocument;
using trismooth::planar_mesh;
using trismooth::PlanarMesh;
using trismooth::RepeatedTriangle;
using trismooth::Triangle;

namespace cell_type = trismooth::cell_type;

namespace {

constexpr std::int32_t side = 12;

MeshDocument document_of(const test_meshes::Mesh& mesh, const std::vector<Triangle>& triangles) {
  MeshDocument document;
  document.format = trismooth::FileFormat::vtu;
  for (const auto& point : mesh.points) {
    document.points.insert(document.points.end(), {point.x, point.y, 0});
  }
  for (const Triangle& triangle : triangles) {
    document.cells.append(cell_type::triangle, triangle);
  }
  return document;
}

/// Listed in every order that a copy may have.
Triangle turned(const Triangle& triangle, std::size_t how) {
  const auto [a, b, c] = triangle;
  return how % 3 == 0 ? triangle : how % 3 == 1 ? Triangle{c, a, b} : Triangle{b, a, c};
}

bool is_said(const std::vector<std::string>& notes, const std::string& words) {
  return std::ranges::any_of(notes, [&](const std::string& note) { return says(note, words); });
}

trismooth::PipelineOptions smoothing_options() {
  trismooth::PipelineOptions options;
  options.input = "mesh.vtu";
  options.output = "out.vtu";
  return options;
}

}  // namespace

TEST_CASE("triangles that are listed again are counted and smoothed once, wherever and however often they are listed") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.3, 3);
  MeshDocument once = document_of(mesh, mesh.triangles);
  const auto expected = trismooth::smooth_document(once, smoothing_options());
  REQUIRE(expected.smoothing->moved_vertices > 50);
  for (const std::size_t every : {1U, 2U, 7U, 50U}) {
    CAPTURE(every);
    std::vector<Triangle> triangles = mesh.triangles;
    for (std::size_t round = 0; round < 3; ++round) {
      for (std::size_t t = round; t < mesh.triangles.size(); t += every) {
        triangles.push_back(turned(mesh.triangles[t], t + round));
      }
    }
    MeshDocument again = document_of(mesh, triangles);
    const auto result = trismooth::smooth_document(again, smoothing_options());
    CHECK(again.points == once.points);
    CHECK(again.cells.size() == triangles.size());
    CHECK(result.input.triangles == expected.input.triangles);
    CHECK(result.input.fixed_vertices == expected.input.fixed_vertices);
    CHECK(result.input.components == 1);
    CHECK(result.input.reoriented_triangles == 0);
    CHECK(result.before.inverted == 0);
    const std::size_t copies = triangles.size() - mesh.triangles.size();
    CHECK(is_said(result.notes, std::to_string(copies) + " triangles are listed again (the first is cell " +
                                    std::to_string(mesh.triangles.size()) + ", a copy of cell 0)"));
  }
}

TEST_CASE("a mesh without repeats has none, and is not copied") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 5);
  const MeshDocument document = document_of(mesh, mesh.triangles);
  const PlanarMesh planar = planar_mesh(document, "mesh.vtu");
  CHECK(planar.repeats.empty());
  CHECK(planar.triangles_of_cells.empty());
  CHECK(planar.notes.empty());
}

TEST_CASE("groups that overlap keep their interfaces: what is listed in two is a region of its own") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.2, 4);
  std::vector<Triangle> triangles = mesh.triangles;
  std::vector<std::int32_t> groups(triangles.size(), 1);  // the whole domain
  std::vector<std::uint8_t> in_coil(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double x = (mesh.points[a].x + mesh.points[b].x + mesh.points[c].x) / 3;
    const double y = (mesh.points[a].y + mesh.points[b].y + mesh.points[c].y) / 3;
    if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) < 0.2) {
      in_coil[t] = 1;
      triangles.push_back(mesh.triangles[t]);
      groups.push_back(2);
    }
  }
  MeshDocument document = document_of(mesh, triangles);
  document.cell_arrays.push_back(trismooth::make_data_array("gmsh:physical", 1, std::move(groups)));
  const PlanarMesh planar = planar_mesh(document, "mesh.vtu");
  const trismooth::Regions regions = trismooth::find_regions(document, planar, {});
  REQUIRE(regions.count() == 2);
  CHECK(regions.names == std::vector<std::string>{"1", "1 + 2"});
  for (std::size_t t = 0; t < in_coil.size(); ++t) {
    REQUIRE(regions.of_triangle[t] == in_coil[t]);
  }
  // And the ends of edges between the two do not move.
  const std::vector<double> before = document.points;
  trismooth::smooth_document(document, smoothing_options());
  std::vector<std::array<bool, 2>> is_of(mesh.points.size(), {false, false});
  for (std::size_t t = 0; t < in_coil.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) {
      is_of[static_cast<std::size_t>(v)][in_coil[t]] = true;
    }
  }
  int ends = 0;
  for (std::size_t v = 0; v < is_of.size(); ++v) {
    if (is_of[v][0] && is_of[v][1]) {
      ++ends;
      CHECK(document.points[3 * v] == before[3 * v]);
      CHECK(document.points[3 * v + 1] == before[3 * v + 1]);
    }
  }
  CHECK(ends > 8);
}

TEST_CASE("triangles of six nodes are copies where they share all of these") {
  MeshDocument document;
  document.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.9, 0};
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5});
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{1, 2, 0, 4, 5, 3});
  document.cells.append(cell_type::quadratic_triangle, std::vector<std::int32_t>{0, 1, 2, 3, 6, 5});
  const PlanarMesh mesh = planar_mesh(document, "mesh.vtu");
  CHECK(mesh.repeats == std::vector<RepeatedTriangle>{{0, 1}});
  REQUIRE(mesh.quadratics.size() == 2);
  CHECK(mesh.quadratics[1].triangle == 1);
  CHECK(mesh.cells == std::vector<std::int32_t>{0, 2});
}

TEST_CASE("what is listed first counts, and what is listed last is the copy") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(4, 4, 0.2, 6);
  std::vector<Triangle> triangles{mesh.triangles.back()};
  triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  const MeshDocument document = document_of(mesh, triangles);
  const PlanarMesh planar = planar_mesh(document, "mesh.vtu");
  CHECK(planar.repeats == std::vector<RepeatedTriangle>{{0, static_cast<std::int32_t>(mesh.triangles.size())}});
}
