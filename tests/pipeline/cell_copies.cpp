// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/cell_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/annotations.h"
#include "trismooth/pipeline/input/planar_mesh.h"
#include "trismooth/pipeline/input/regions.h"
#include "trismooth/pipeline/input/slide_lines.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/says.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::cell_copies_test {

using Numbers = std::vector<std::int32_t>;

constexpr std::int32_t side = 12;

MeshDocument document_of(const test_meshes::Mesh& mesh, const std::vector<Triangle>& triangles) {
  MeshDocument document = triangle_document({mesh.points, triangles});
  document.format = trismooth::FileFormat::vtu;
  return document;
}

/// Listed in every order that a copy may have.
Triangle turned(const Triangle& triangle, std::size_t how) {
  const auto [a, b, c] = triangle;
  return how % 3 == 0 ? triangle : how % 3 == 1 ? Triangle{c, a, b} : Triangle{b, a, c};
}

int count_saying(const std::vector<std::string>& notes, const std::string& words) {
  return static_cast<int>(std::ranges::count_if(notes, [&](const std::string& note) { return says(note, words); }));
}

PipelineOptions smoothing_options() {
  PipelineOptions options;
  options.input = "mesh.vtu";
  options.output = "out.vtu";
  return options;
}

PlanarMesh mesh_without_copies(const MeshDocument& document) {
  trismooth::Workers workers(1);
  PlanarMesh mesh = trismooth::planar_mesh(document, "mesh.vtu", workers);
  take_out_copies(mesh, workers);
  return mesh;
}

/// A jittered grid whose middle is listed a second time.
struct Overlapping {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.2, 4);
  std::vector<std::uint8_t> in_part = std::vector<std::uint8_t>(mesh.triangles.size(), 0);
  std::vector<Triangle> listed = mesh.triangles;
  Numbers groups = Numbers(mesh.triangles.size(), 1);

  Overlapping() {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const double x = (mesh.points[a].x + mesh.points[b].x + mesh.points[c].x) / 3;
      const double y = (mesh.points[a].y + mesh.points[b].y + mesh.points[c].y) / 3;
      if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) < 0.2) {
        in_part[t] = 1;
        listed.push_back(mesh.triangles[t]);
        groups.push_back(2);
      }
    }
  }

  /// Vertices of triangles of both kinds.
  Numbers on_border() const {
    std::vector<std::array<bool, 2>> is_of(mesh.points.size(), {false, false});
    for (std::size_t t = 0; t < in_part.size(); ++t) {
      for (const std::int32_t v : mesh.triangles[t]) {
        is_of[static_cast<std::size_t>(v)][in_part[t]] = true;
      }
    }
    Numbers border;
    for (std::size_t v = 0; v < is_of.size(); ++v) {
      if (is_of[v][0] && is_of[v][1]) {
        border.push_back(static_cast<std::int32_t>(v));
      }
    }
    return border;
  }
};

TEST_CASE("triangles that are listed again are counted and smoothed once, wherever and however often they are listed") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.3, 3);
  for (const auto method : {trismooth::Method::smart, trismooth::Method::mean_ratio}) {
    PipelineOptions options = smoothing_options();
    options.smoothing.method = method;
    MeshDocument once = document_of(mesh, mesh.triangles);
    const auto expected = trismooth::smooth_document(once, options);
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
      const auto result = trismooth::smooth_document(again, options);
      CHECK(again.points == once.points);
      CHECK(again.cells.size() == triangles.size());
      CHECK(result.input.triangles == expected.input.triangles);
      CHECK(result.input.other_cells == 0);
      CHECK(result.input.fixed_vertices == expected.input.fixed_vertices);
      CHECK(result.input.components == 1);
      CHECK(result.input.reoriented_triangles == 0);
      CHECK(result.before.triangles == expected.before.triangles);
      CHECK(result.before.inverted == 0);
      CHECK(result.after->inverted == 0);
      const std::size_t copies = triangles.size() - mesh.triangles.size();
      CHECK(count_saying(result.notes, std::to_string(copies) + " triangles are listed again (the first is cell " +
                                           std::to_string(mesh.triangles.size()) +
                                           ", which has the corners of cell 0)") == 1);
      CHECK(count_saying(result.notes, "listed") == 1);
    }
  }
}

TEST_CASE("a corner of the boundary whose only triangle is listed again, the other way round, does not move") {
  // All triangles are at the boundary, and the first vertex has one alone.
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  MeshDocument document;
  document.points = points;
  for (const Triangle& triangle : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{3, 1, 0}, Triangle{1, 3, 2}}) {
    document.cells.append(cell_type::triangle, triangle);
  }
  const auto result = trismooth::smooth_document(document, smoothing_options());
  CHECK(result.input.free_vertices == 0);
  CHECK(result.before.inverted == 0);
  CHECK(document.points == points);
}

TEST_CASE("a mesh in which nothing is listed again is not copied, and nothing is said") {
  const test_meshes::Mesh mesh = test_meshes::jittered_grid(40, 40, 0.3, 5);
  const MeshDocument document = document_of(mesh, mesh.triangles);
  const PlanarMesh planar = mesh_without_copies(document);
  CHECK(planar.copies.empty());
  CHECK(planar.elements.triangles()[0].data() == document.cells.connectivity.data());
  CHECK(planar.notes.empty());
}

TEST_CASE("groups that overlap keep their borders: what is in both is a region of its own, and that is said") {
  const Overlapping overlapping;
  MeshDocument document = document_of(overlapping.mesh, overlapping.listed);
  document.cell_arrays.push_back(make_data_array("gmsh:physical", 1, Numbers(overlapping.groups)));
  const PlanarMesh planar = mesh_without_copies(document);
  const trismooth::Regions regions = trismooth::find_regions(document, planar, {});
  REQUIRE(regions.count() == 2);
  CHECK(regions.names == std::vector<std::string>{"1", "1 + 2"});
  REQUIRE(regions.of_triangle.size() == overlapping.in_part.size());
  for (std::size_t t = 0; t < regions.of_triangle.size(); ++t) {
    REQUIRE(regions.of_triangle[t] == overlapping.in_part[t]);
  }
  CHECK(count_saying(regions.notes, std::to_string(overlapping.listed.size() - overlapping.mesh.triangles.size()) +
                                        " triangles are listed in several regions") == 1);
  const std::vector<double> before = document.points;
  const auto result = trismooth::smooth_document(document, smoothing_options());
  CHECK(result.smoothing->moved_vertices > 20);
  const Numbers border = overlapping.on_border();
  REQUIRE(border.size() > 8);
  for (const std::int32_t v : border) {
    CHECK(std::equal(before.begin() + 3 * v, before.begin() + 3 * v + 3, document.points.begin() + 3 * v));
  }
}

TEST_CASE(
    "texts at cells that overlap are named together, and an array that says the same of copies gives one region") {
  const Overlapping overlapping;
  MeshDocument document = document_of(overlapping.mesh, overlapping.listed);
  Numbers texts = overlapping.groups;
  std::ranges::transform(texts, texts.begin(), [](std::int32_t group) { return group - 1; });
  document.cell_labels.push_back({"group", texts, {"all", "part"}});
  document.cell_arrays.push_back(make_data_array("material", 1, Numbers(overlapping.groups.size(), 7)));
  const PlanarMesh planar = mesh_without_copies(document);
  const std::vector<std::string> by_texts{"group"};
  CHECK(trismooth::find_regions(document, planar, by_texts).names == std::vector<std::string>{"all", "all + part"});
  const std::vector<std::string> by_material{"material"};
  const trismooth::Regions one = trismooth::find_regions(document, planar, by_material);
  CHECK(one.names == std::vector<std::string>{"7"});
  CHECK(one.notes.empty());
}

TEST_CASE("the file that is written has every cell with its data, and copies have the metrics of their triangle") {
  const Overlapping overlapping;
  MeshDocument document = document_of(overlapping.mesh, overlapping.listed);
  document.cell_arrays.push_back(make_data_array("gmsh:physical", 1, Numbers(overlapping.groups)));
  const ScratchFolder folder;
  PipelineOptions options;
  options.input = folder / "in.vtu";
  options.output = folder / "out.vtu";
  options.annotate = true;
  options.annotated_size_ratio = true;
  trismooth::write_mesh(options.input, document);
  trismooth::run_pipeline(options);
  const MeshDocument written = trismooth::read_mesh(*options.output);
  CHECK(written.cells.connectivity == document.cells.connectivity);
  const auto* const groups = trismooth::find_array(written.cell_arrays, "gmsh:physical");
  REQUIRE(groups != nullptr);
  CHECK(std::ranges::equal(groups->as<std::int32_t>(), overlapping.groups));
  for (const char* const name : {"trismooth:shape", "trismooth:size_ratio"}) {
    CAPTURE(name);
    const auto* const values = trismooth::find_array(written.cell_arrays, name);
    REQUIRE(values != nullptr);
    std::map<Triangle, double> of_triangle;
    for (std::size_t c = 0; c < overlapping.listed.size(); ++c) {
      const double value = values->value(c);
      CHECK(value > 0);
      CHECK(of_triangle.try_emplace(overlapping.listed[c], value).first->second == value);
    }
  }
}

TEST_CASE("a strip is as bad as its worst triangle, also where that is listed before") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0.1, 0};
  document.cells.append(cell_type::triangle, Numbers{1, 3, 2});
  document.cells.append(cell_type::triangle_strip, Numbers{0, 1, 2, 3});
  document.cells.append(cell_type::triangle_strip, Numbers{3, 2, 1, 0});
  const PlanarMesh mesh = mesh_without_copies(document);
  CHECK(mesh.cells == trismooth::BulkVector<std::int32_t>{0, 1});
  CHECK(mesh.copies == std::vector<CellCopy>{{0, 1}, {0, 2}, {1, 2}});
  trismooth::Workers workers(1);
  const auto arrays =
      trismooth::metric_annotations(std::vector{trismooth::Metric::max_angle}, {mesh.points, mesh.elements, {}, 0},
                                    mesh.cells, 3, workers, "", mesh.copies);
  CHECK(arrays[0].value(0) > 130);
  CHECK(arrays[0].value(1) == arrays[0].value(0));
  CHECK(arrays[0].value(2) == arrays[0].value(0));
}

TEST_CASE(
    "triangles of six nodes are copies whatever order they have, and others of their corners hold their vertices") {
  MeshDocument document;
  document.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.9, 0};
  document.cells.append(cell_type::quadratic_triangle, Numbers{0, 1, 2, 3, 4, 5});
  document.cells.append(cell_type::quadratic_triangle, Numbers{1, 2, 0, 4, 5, 3});
  document.cells.append(cell_type::quadratic_triangle, Numbers{1, 0, 2, 3, 5, 4});
  document.cells.append(cell_type::triangle, Numbers{2, 1, 0});
  const PlanarMesh mesh = mesh_without_copies(document);
  CHECK(mesh.copies == std::vector<CellCopy>{{0, 1}, {0, 2}, {0, 3}});
  CHECK(mesh.other_cells == 0);
  CHECK(mesh.quadratics.size() == 1);
  document.cells.append(cell_type::quadratic_triangle, Numbers{0, 1, 2, 3, 6, 5});
  const PlanarMesh with_other = mesh_without_copies(document);
  CHECK(with_other.elements.size() == 1);
  CHECK(with_other.copies.size() == 3);
  CHECK(with_other.other_cells == 1);
  CHECK(with_other.in_other_cell == std::vector<std::uint8_t>{1, 1, 1, 1, 0, 1, 1});
  CHECK(count_saying(with_other.notes, "1 of the triangles that are listed again has other middles") == 1);
}

TEST_CASE("a quadrilateral that repeats a corner may be a triangle that is listed before") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  document.cells.append(cell_type::triangle, Numbers{0, 1, 2});
  document.cells.append(cell_type::quad, Numbers{2, 1, 0, 0});
  CHECK(mesh_without_copies(document).copies == std::vector<CellCopy>{{0, 1}});
}

TEST_CASE("sides that a copy alone names are named, and copies are no cells of other types where vertices slide") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.4, 0.6, 0};
  for (const Numbers& cell : {Numbers{0, 1, 4}, {1, 2, 4}, {0, 3}, {2, 3, 4}, {3, 0, 4}, {4, 2, 1}}) {
    document.cells.append(cell.size() == 2 ? cell_type::line : cell_type::triangle, cell);
  }
  document.cell_arrays.push_back(make_data_array("skfem:b:spoke", 1, Numbers{0, 0, 0, 0, 0, 1}));
  const PlanarMesh mesh = mesh_without_copies(document);
  CHECK(mesh.copies.size() == 1);
  CHECK(mesh.in_other_cell == std::vector<std::uint8_t>{1, 0, 1, 1, 1});
  const trismooth::SlideLines lines = find_slide_lines(document, mesh, {});
  CHECK(lines.notes ==
        std::vector<std::string>{"1 of these cells is a line, which holds nothing with --slide: their vertices slide "
                                 "where nothing else holds them"});
  CHECK(lines.lines == Numbers{0, 3, 2, 4});
  CHECK(lines.in_other_cell == std::vector<std::uint8_t>(5, 0));
}

TEST_CASE("corners that are joined may make triangles copies of each other") {
  test_meshes::Mesh mesh = test_meshes::jittered_grid(side, side, 0.3, 8);
  MeshDocument once = document_of(mesh, mesh.triangles);
  PipelineOptions options = smoothing_options();
  options.merge = 0;
  trismooth::smooth_document(once, options);
  // The whole mesh a second time, with points of its own.
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  const std::size_t triangles = mesh.triangles.size();
  mesh.points.insert(mesh.points.end(), mesh.points.begin(), mesh.points.end());
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({b + count, a + count, c + count});
  }
  MeshDocument twice = document_of(mesh, mesh.triangles);
  const auto result = trismooth::smooth_document(twice, options);
  CHECK(result.input.triangles == static_cast<std::int64_t>(triangles));
  CHECK(result.before.inverted == 0);
  CHECK(std::equal(once.points.begin(), once.points.end(), twice.points.begin()));
  CHECK(std::equal(once.points.begin(), once.points.end(), twice.points.begin() + std::ssize(once.points)));
}

}  // namespace trismooth::cell_copies_test
