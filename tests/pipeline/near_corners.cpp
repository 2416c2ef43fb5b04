// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/near_corners.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/says.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

namespace trismooth::near_corners_test {

trismooth::MeshDocument document_of(const std::vector<Point2<double>>& points, const std::vector<Triangle>& triangles) {
  trismooth::MeshDocument document;
  for (const auto& [x, y] : points) {
    document.points.insert(document.points.end(), {x, y, 0});
  }
  for (const Triangle& triangle : triangles) {
    document.cells.append(trismooth::cell_type::triangle, triangle);
  }
  return document;
}

/// A grid of n x n squares, each of two triangles with three vertices of their own, off their places by `off` at most.
struct ApartTriangles {
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;

  ApartTriangles(int n, double off) {
    const auto add = [&](int i, int j) {
      const auto v = static_cast<std::int32_t>(points.size());
      const double turn = (v * 7 % 11) / 11.0;
      points.push_back({i + off * turn / 2, j - off * (1 - turn) / 2});
      return v;
    };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        triangles.push_back({add(i, j), add(i + 1, j), add(i + 1, j + 1)});
        triangles.push_back({add(i, j), add(i + 1, j + 1), add(i, j + 1)});
      }
    }
  }
};

TEST_CASE("corners join where they are near each other, and nowhere else") {
  const ApartTriangles exact(5, 0);
  for (const double distance : {0.0, 1e-9, 0.4}) {
    const std::vector<std::int32_t> joined = join_near_corners(exact.points, exact.triangles, distance);
    std::int32_t firsts = 0;
    for (std::size_t v = 0; v < joined.size(); ++v) {
      const auto first = static_cast<std::size_t>(joined[v]);
      CHECK(joined[first] == joined[v]);
      CHECK(exact.points[first] == exact.points[v]);
      firsts += first == v ? 1 : 0;
    }
    CHECK(firsts == 36);
  }
  const ApartTriangles near(5, 1e-6);
  CHECK(join_near_corners(near.points, near.triangles, 0).back() == std::ssize(near.points) - 1);
  CHECK(join_near_corners(near.points, near.triangles, 1e-6).back() != std::ssize(near.points) - 1);
}

TEST_CASE("corners join at every place of coordinates that are whole multiples of the distance") {
  // As files of six decimals have them, and people ask for the last one.
  constexpr double distance = 1e-6;
  constexpr int most = 3000;
  std::vector<Point2<double>> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < most; ++i) {
    const double x = 46 + 7919 * i * distance;
    const double y = 182 - 104729 * i * distance;
    for (const double off : {0.0, 1e-9}) {
      const auto v = static_cast<std::int32_t>(points.size());
      points.insert(points.end(), {{x + off, y}, {x + 0.003, y + off}, {x, y + 0.003 - off}});
      triangles.push_back({v, v + 1, v + 2});
    }
  }
  const std::vector<std::int32_t> joined = join_near_corners(points, triangles, distance);
  std::vector<std::int32_t> missing;
  for (std::int32_t v = 0; v < std::ssize(joined); ++v) {
    const bool is_copy = v % 6 >= 3;
    if (joined[v] != (is_copy ? v - 3 : v)) {
      missing.push_back(v);
    }
  }
  CHECK(missing == std::vector<std::int32_t>{});
}

TEST_CASE("corners of the smallest and largest coordinates join, and vertices of no triangle do not") {
  constexpr double largest = std::numeric_limits<double>::max() / 4;
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const std::vector<Point2<double>> points{{largest, -largest}, {smallest, 0}, {-largest, 0},
                                           {largest, -largest}, {0, 0},        {largest, -largest}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 2}};
  CHECK(join_near_corners(points, triangles, 0) == std::vector<std::int32_t>{0, 1, 2, 0, 4, 5});
  CHECK(join_near_corners(points, triangles, smallest) == std::vector<std::int32_t>{0, 1, 2, 0, 1, 5});
}

/// A mesh, and the same one with a vertex of its own for each corner: the first triangle at a vertex has the vertex,
/// the others have copies behind all vertices, off it by `off` at most.
struct CutMesh {
  MeshDocument whole;
  MeshDocument cut;
  std::vector<std::int32_t> original;  ///< of every vertex of `cut`

  explicit CutMesh(double off) {
    const test_meshes::Mesh mesh = test_meshes::jittered_grid(14, 11, 0.4, 3);
    std::vector<std::uint8_t> is_taken(mesh.points.size(), 0);
    whole = triangle_document(mesh);
    original.resize(mesh.points.size());
    std::iota(original.begin(), original.end(), 0);
    cut.points = whole.points;
    for (const Triangle& triangle : mesh.triangles) {
      Triangle apart = triangle;
      for (std::int32_t& v : apart) {
        if (std::exchange(is_taken[v], std::uint8_t{1}) != 0) {
          const double turn = static_cast<double>(original.size() % 7) / 7;
          cut.points.insert(cut.points.end(),
                            {mesh.points[v].x + off * turn / 2, mesh.points[v].y - off * turn / 2, 0});
          original.push_back(v);
          v = static_cast<std::int32_t>(original.size()) - 1;
        }
      }
      cut.cells.append(trismooth::cell_type::triangle, apart);
    }
  }
};

TEST_CASE("merged corners move as the vertices of the whole mesh do, and the file keeps its own") {
  for (const double off : {0.0, 1e-7}) {
    CAPTURE(off);
    CutMesh mesh(off);
    const std::vector<std::int32_t> connectivity = mesh.cut.cells.connectivity;
    PipelineOptions options;
    const PipelineResult whole = smooth_document(mesh.whole, options);
    CHECK(smooth_document(mesh.cut, options).input.free_vertices == 0);
    options.merge = off;
    const PipelineResult merged = smooth_document(mesh.cut, options);
    CHECK(merged.input.free_vertices == whole.input.free_vertices);
    CHECK(merged.input.fixed_vertices == whole.input.fixed_vertices);
    CHECK(merged.input.held.boundary == whole.input.held.boundary);
    CHECK(merged.input.merged_vertices == std::ssize(mesh.original) - whole.input.vertices);
    CHECK(merged.smoothing->moved_vertices == whole.smoothing->moved_vertices);
    CHECK(mesh.cut.cells.connectivity == connectivity);
    std::int64_t apart = 0;
    for (std::size_t v = 0; v < mesh.original.size(); ++v) {
      const std::size_t first = 3 * static_cast<std::size_t>(mesh.original[v]);
      CHECK(mesh.cut.points[first] == mesh.whole.points[first]);
      CHECK(mesh.cut.points[first + 1] == mesh.whole.points[first + 1]);
      apart += mesh.cut.points[3 * v] != mesh.cut.points[first] ? 1 : 0;
    }
    // Copies of what is fixed stay where they are.
    CHECK((apart > 0) == (off > 0));
    CHECK(apart < merged.input.merged_vertices / 2);
  }
}

TEST_CASE("values that follow the mesh are those of the place at all corners that are merged there") {
  CutMesh mesh(0);
  const auto value_at = [&](std::size_t v) { return 10 + mesh.cut.points[3 * v] + 2 * mesh.cut.points[3 * v + 1]; };
  std::vector<double> values(mesh.original.size());
  for (std::size_t v = 0; v < values.size(); ++v) {
    values[v] = value_at(v);
  }
  mesh.cut.point_arrays.push_back(trismooth::make_data_array("head", 1, values));
  PipelineOptions options;
  options.merge = 0;
  options.fields = trismooth::Fields::interpolate;
  options.output = "out.vtk";
  CHECK(smooth_document(mesh.cut, options).fields.front().interpolated_vertices > 100);
  for (std::size_t v = 0; v < values.size(); ++v) {
    CHECK(mesh.cut.point_arrays.front().value(v) == Approx(value_at(v)).epsilon(1e-12));
  }
}

TEST_CASE("what holds a merged corner holds all that it goes with") {
  CutMesh mesh(0);
  PipelineOptions options;
  options.merge = 0;
  const std::int64_t free = smooth_document(mesh.cut, options).input.free_vertices;
  // The last corner inside is a copy.
  const auto copies_of = [&](std::int32_t v) { return std::ranges::count(mesh.original, v); };
  auto last = static_cast<std::int32_t>(mesh.original.size()) - 1;
  while (copies_of(mesh.original[static_cast<std::size_t>(last)]) < 6) {
    --last;
  }
  const std::size_t first = 3 * static_cast<std::size_t>(mesh.original[static_cast<std::size_t>(last)]);
  options.fixed_vertices = {last};
  CutMesh held(0);
  const double before = held.cut.points[first];
  CHECK(smooth_document(held.cut, options).input.free_vertices == free - 1);
  CHECK(held.cut.points[first] == before);
}

TEST_CASE("a distance that joins corners of one triangle is refused, as are ways of smoothing that know no merging") {
  CutMesh mesh(0);
  PipelineOptions options;
  options.merge = 0.5;
  CHECK(says(message_of<std::invalid_argument>([&] { smooth_document(mesh.cut, options); }),
             "--merge 0.5 would join two corners of the triangle in cell 0; the shortest side of the mesh is"));
  trismooth::MeshDocument nowhere = document_of({{1, 1}, {1, 1}, {1, 1}}, {{0, 1, 2}});
  CHECK(says(message_of<std::invalid_argument>([&] { smooth_document(nowhere, options); }),
             "--merge 0.5 would join two corners of the triangle in cell 0; no side of the mesh has a length"));
  options.merge = 0;
  options.slide.along = trismooth::Slide::straight;
  CHECK(says(message_of<std::invalid_argument>([&] { smooth_document(mesh.cut, options); }), "leave out --slide"));
}

TEST_CASE("a mesh whose triangles share no side is told why no vertex is free") {
  const ScratchFolder folder;
  const auto notes_of = [&](const ApartTriangles& mesh) {
    trismooth::PipelineOptions options;
    options.input = folder / "apart.off";
    options.output = folder / "out.off";
    trismooth::write_mesh(options.input, document_of(mesh.points, mesh.triangles));
    std::string all;
    for (const std::string& note : trismooth::run_pipeline(options).notes) {
      all += note + '\n';
    }
    return all;
  };
  CHECK(says(notes_of(ApartTriangles(3, 0)),
             "no two of the 18 triangles share a side, so all vertices are on boundaries: 38 of their corners lie "
             "where others do"));
  CHECK(says(notes_of(ApartTriangles(3, 1e-7)), "38 of their corners nearly coincide with others, within "));
  ApartTriangles far(1, 0);
  for (std::size_t v = 3; v < 6; ++v) {
    far.points[v].x += 3;
  }
  CHECK(says(notes_of(far), "no two of the 2 triangles share a side, so all vertices are on boundaries\n"));
}

}  // namespace trismooth::near_corners_test
