// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals that cannot be smoothed as they are listed: they are held, and a note says why, with the way out.
#include "trismooth/pipeline/input/odd_quads.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/mixed_document.h"
#include "support/mixed_meshes.h"
#include "support/says.h"
#include "support/scratch_folder.h"

namespace trismooth::odd_quads_test {

using mixed_meshes::MixedMesh;
using Numbers = std::vector<double>;
using Nodes = std::vector<std::int32_t>;

PipelineOptions options_of(Method method, Untangle untangle = Untangle::off) {
  PipelineOptions options;
  options.smoothing.method = method;
  options.smoothing.untangle = untangle;
  return options;
}

std::int64_t sentences_of(const std::vector<std::string>& sentences, const std::string& words) {
  return std::ranges::count_if(sentences, [&](const std::string& sentence) { return says(sentence, words); });
}

std::size_t square_in(const MixedMesh& mesh, std::size_t from) {
  while (mesh.is_triangle(from)) {
    ++from;
  }
  return from;
}

TEST_CASE("a quadrilateral whose corners are not listed in turn is held and told, and all others are smoothed") {
  for (const std::uint64_t thirds : {0U, 1U}) {
    for (const Method method : {Method::smart, Method::mean_ratio, Method::laplacian}) {
      MixedMesh mesh(7, 6, 0.25, 5, thirds);
      const std::size_t e = square_in(mesh, 20);
      const Nodes around = mesh.corners(e);
      std::swap(mesh.elements[e][1], mesh.elements[e][2]);
      MeshDocument document = document_of(mesh);
      const PipelineResult result = smooth_document(document, options_of(method));
      CHECK(sentences_of(result.notes, "1 quadrilateral does not list its corners in turn") == 1);
      CHECK(sentences_of(result.notes, "the first is cell " + std::to_string(e)) == 1);
      CHECK(result.input.other_cells == 1);
      CHECK(result.before.inverted == 1);
      CHECK(result.after->inverted == 1);
      CHECK(sentences_of(result.warnings, "remain") == 0);
      CHECK(result.before.elements() + 1 == std::ssize(mesh.elements));

      // As if it had never been there, with its vertices named.
      MixedMesh others = mesh;
      others.elements.erase(others.elements.begin() + static_cast<std::ptrdiff_t>(e));
      MeshDocument expected = document_of(others);
      PipelineOptions options = options_of(method);
      options.fixed_vertices = around;
      CHECK(smooth_document(expected, options).smoothing->moved_vertices > 10);
      CHECK(document.points == expected.points);
    }
  }
}

TEST_CASE("whoever knows the elements around some vertices finds out that quadrilaterals may not be in turn") {
  const auto may_be_found = [](const MixedMesh& mesh) {
    std::vector<Point2<double>> points;
    for (const auto& [x, y] : mesh.points) {
      points.push_back({x, y});
    }
    bool found = false;
    for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
      std::vector<MixedElement> around;
      std::ranges::copy_if(mesh.elements, std::back_inserter(around),
                           [v](const auto& corners) { return std::ranges::count(corners, v) > 0; });
      std::vector<std::uint8_t> ghosts(points.size(), 1);
      ghosts[static_cast<std::size_t>(v)] = 0;
      found = may_have_crossed_quads(points, around, ghosts) || found;
    }
    return found;
  };
  for (const std::uint64_t thirds : {0U, 1U}) {
    const MixedMesh mesh(7, 6, 0.6, 5, thirds);
    CHECK_FALSE(may_be_found(mesh));
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      if (!mesh.is_triangle(e)) {
        MixedMesh crossed = mesh;
        std::swap(crossed.elements[e][1], crossed.elements[e][2]);
        MeshDocument document = document_of(crossed);
        const bool is_held = check_document(document, {}).input.crossed_quadrilaterals > 0;
        CHECK((may_be_found(crossed) || !is_held));
      }
    }
  }
}

TEST_CASE("a file whose quadrilaterals all list their corners by rows is refused, with what is to be done") {
  MixedMesh mesh(5, 4, 0.2, 1, 0);
  for (auto& corners : mesh.elements) {
    std::swap(corners[2], corners[3]);
  }
  MeshDocument document = document_of(mesh);
  CHECK_THROWS_WITH(smooth_document(document, {}),
                    Catch::Contains("20 are quadrilaterals whose corners are not listed in turn"));
}

TEST_CASE("a quadrilateral that crosses itself since a vertex is misplaced stays an element, and is untangled") {
  MixedMesh mesh(6, 6, 0.1, 2, 0);
  // Beyond the opposite side of the square to the right of it and above.
  mesh.points[3 * 7 + 3] = {4.6, 3.4};
  MeshDocument document = document_of(mesh);
  const PipelineResult result = smooth_document(document, options_of(Method::smart, Untangle::on));
  CHECK(result.input.other_cells == 0);
  CHECK(result.before.inverted > 1);
  CHECK(result.after->inverted == 0);
  CHECK(sentences_of(result.notes, "in turn") == 0);
}

/// Rows of squares, or of triangles, and between the middle ones a row of quadrilaterals without thickness.
MixedMesh layered(std::int32_t columns, std::uint64_t thirds) {
  MixedMesh mesh(columns, 5, 0.2, 3, thirds);
  for (std::int32_t column = 0; column <= columns; ++column) {
    const std::int32_t below = 2 * (columns + 1) + column;
    const std::int32_t above = below + columns + 1;
    mesh.points[static_cast<std::size_t>(above)] = mesh.points[static_cast<std::size_t>(below)];
  }
  const auto in_middle = [&](std::int32_t v) { return v / (columns + 1) == 2 || v / (columns + 1) == 3; };
  std::erase_if(mesh.elements, [&](const auto& corners) {
    return std::ranges::all_of(corners, [&](std::int32_t v) { return v < 0 || in_middle(v); });
  });
  for (std::int32_t column = 0; column < columns; ++column) {
    const std::int32_t a = 2 * (columns + 1) + column;
    mesh.elements.push_back({a, a + 1, a + columns + 2, a + columns + 1});
  }
  return mesh;
}

TEST_CASE("quadrilaterals without thickness keep their sides together, whatever smooths the rest, and a note says so") {
  constexpr std::int32_t columns = 7;
  for (const std::uint64_t thirds : {0U, 3U}) {
    for (const Method method : {Method::smart, Method::mean_ratio, Method::laplacian}) {
      const MixedMesh mesh = layered(columns, thirds);
      MeshDocument document = document_of(mesh);
      const PipelineResult result = smooth_document(document, options_of(method, Untangle::on));
      CHECK(sentences_of(result.notes, "7 quadrilaterals have no thickness") == 1);
      CHECK(sentences_of(result.notes, "--fixed-set none frees them") == 1);
      CHECK(result.before.degenerate == columns);
      CHECK(result.after->degenerate == columns);
      CHECK(result.smoothing->moved_vertices > 0);
      for (std::size_t v = 2 * (columns + 1); v < 4 * (columns + 1); ++v) {
        CHECK(document.points[3 * v] == mesh.points[v][0]);
        CHECK(document.points[3 * v + 1] == mesh.points[v][1]);
      }
    }
  }
  MeshDocument document = document_of(layered(columns, 0));
  PipelineOptions options = options_of(Method::laplacian);
  options.fixed_sets = {"none"};
  const PipelineResult result = smooth_document(document, options);
  CHECK(sentences_of(result.notes, "no thickness") == 0);
  CHECK(result.after->degenerate < columns);
}

TEST_CASE("cohesive elements of Abaqus keep their thickness, and a note says so") {
  const ScratchFolder folder;
  // Two rows of triangles, and between them one of elements without thickness.
  std::string text = "*NODE\n";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 7; ++column) {
      const double y = row < 2 ? row : row - 1;
      text += std::to_string(7 * row + column + 1) + ", " + std::to_string(column + (row == 1 || row == 2 ? 0.2 : 0)) +
              ", " + std::to_string(y) + "\n";
    }
  }
  const auto rows = [&](const std::string& type, int first_element, const std::vector<int>& of, bool cuts) {
    text += "*ELEMENT, TYPE=" + type + "\n";
    for (const int row : of) {
      for (int column = 0; column < 6; ++column) {
        const int a = 7 * row + column + 1;
        const auto line = [&](const std::vector<int>& nodes) {
          text += std::to_string(first_element++);
          for (const int node : nodes) {
            text += ", " + std::to_string(node);
          }
          text += '\n';
        };
        if (cuts) {
          line({a, a + 1, a + 8});
          line({a, a + 8, a + 7});
        } else {
          line({a, a + 1, a + 8, a + 7});
        }
      }
    }
  };
  rows("CPS3", 1, {0, 2}, true);
  rows("COH2D4", 101, {1}, false);
  folder.write("cohesive.inp", text);
  PipelineOptions options = options_of(Method::laplacian);
  options.input = folder / "cohesive.inp";
  options.output = folder / "out.inp";
  const PipelineResult result = run_pipeline(options);
  CHECK(sentences_of(result.notes, "6 cohesive or gasket elements keep their thickness") == 1);
  CHECK(bytes_of(*options.output) == bytes_of(options.input));
  options.fixed_sets = {"none"};
  CHECK(run_pipeline(options).smoothing->moved_vertices > 0);
}

TEST_CASE("quadrilaterals of cubic sides are kept, and named") {
  MeshDocument document = document_of(MixedMesh(4, 4, 0.1, 3, 0));
  const auto first = static_cast<std::int32_t>(document.point_count());
  std::vector<std::int32_t> sixteen(16);
  for (std::int32_t i = 0; i < 16; ++i) {
    const std::int32_t row = i / 4;
    document.points.insert(document.points.end(), {9.0 + i % 4, static_cast<double>(row), 0});
    sixteen[static_cast<std::size_t>(i)] = first + i;
  }
  document.cells.append(cell_type::lagrange_quad, sixteen);
  const PipelineResult result = smooth_document(document, options_of(Method::smart));
  CHECK(result.input.other_cells == 1);
  CHECK(sentences_of(result.notes, "1 of these cells is a quadrilateral of six nodes, or of more than nine") == 1);
  CHECK(sentences_of(result.notes, "of other types than triangle and quadrilateral") == 1);
}

TEST_CASE("quadrilaterals that repeat a node are held and named apart from cells of other types") {
  // A square of eight nodes, beside one of eight whose middle is a corner and one of nine that is a triangle.
  MeshDocument document;
  document.format = FileFormat::vtk;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 7; ++column) {
      document.points.insert(document.points.end(), {double(column), double(row), 0});
    }
  }
  document.cells.append(cell_type::quadratic_quad, Nodes{0, 2, 16, 14, 1, 9, 15, 7});
  document.cells.append(cell_type::quadratic_quad, Nodes{2, 4, 18, 16, 2, 11, 17, 9});
  document.cells.append(cell_type::biquadratic_quad, Nodes{4, 6, 18, 18, 5, 12, 18, 11, 13});
  document.cells.append(cell_type::vertex, Nodes{20});
  const PipelineResult result = check_document(document, {});
  CHECK(result.input.other_cells == 3);
  CHECK(sentences_of(result.notes, "2 quadrilaterals repeating a node (the first is cell 1): kept as they are") == 1);
  CHECK(sentences_of(result.notes, "1 cell of other types than triangle and quadrilateral") == 1);
}

TEST_CASE("middles that are corners of other elements, or of several sides, are told with what they hold") {
  // Squares of nine nodes, side by side: those of each row of squares by their own numbers.
  const auto squares = [] {
    std::vector<Nodes> cells;
    for (std::int32_t row = 0; row < 4; ++row) {
      for (std::int32_t column = 0; column < 4; ++column) {
        const std::int32_t a = 2 * (9 * row + column);
        cells.push_back({a, a + 2, a + 20, a + 18, a + 1, a + 11, a + 19, a + 9, a + 10});
      }
    }
    return cells;
  };
  const auto notes_of = [](const std::vector<Nodes>& cells) {
    MeshDocument document;
    document.format = FileFormat::vtk;
    for (int v = 0; v < 81; ++v) {
      const int row = v / 9;
      document.points.insert(document.points.end(), {double(v % 9), double(row), 0});
    }
    for (const Nodes& nodes : cells) {
      document.cells.append(cell_type::biquadratic_quad, nodes);
    }
    return check_document(document, {}).notes;
  };
  const std::string one = "1 node in the middle of a side or element is a corner as well, or in the middle of others";
  CHECK(sentences_of(notes_of(squares()), "in the middle of") == 0);
  std::vector<Nodes> of_a_corner = squares();
  of_a_corner[5][4] = of_a_corner[0][0];
  CHECK(sentences_of(notes_of(of_a_corner), one) == 1);
  std::vector<Nodes> of_two_sides = squares();
  of_two_sides[5][4] = of_two_sides[0][4];
  CHECK(sentences_of(notes_of(of_two_sides), one) == 1);
  std::vector<Nodes> of_two_centres = squares();
  of_two_centres[5][8] = of_two_centres[6][8] = of_two_centres[9][8];
  CHECK(sentences_of(notes_of(of_two_centres), one) == 1);
}

}  // namespace trismooth::odd_quads_test
