// SPDX-License-Identifier: BSD-3-Clause
// trismooth deform of meshes with quadrilaterals.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "command_line_calls.h"
#include "support/mixed_document.h"
#include "support/mixed_meshes.h"
#include "support/scratch_folder.h"

namespace trismooth::deform_quadrilaterals_test {

using namespace command_line_calls;
using mixed_meshes::MixedMesh;

constexpr std::int32_t width = 10;  ///< squares of the grids

/// The upper side of a grid becomes a wave, its ends and all other sides stay.
double rise_of(const MixedMesh& mesh, std::size_t v) {
  const bool is_on_top = v >= std::size_t{width + 1} * width;
  return is_on_top && v < mesh.points.size() ? 2 * std::sin(std::acos(-1) * mesh.points[v][0] / width) : 0;
}

/// A square whose upper side is straight at rest.
MixedMesh grid(std::uint64_t thirds) {
  MixedMesh mesh(width, width, 0.15, 7, thirds);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::size_t column = v % (width + 1);
    const std::size_t row = v / (width + 1);
    if (column % width == 0 || row % width == 0) {
      mesh.points[v] = {static_cast<double>(column), static_cast<double>(row)};
    }
  }
  return mesh;
}

void add_motion(const MixedMesh& mesh, MeshDocument& document) {
  std::vector<double> motion;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    motion.insert(motion.end(), {0, rise_of(mesh, v), 0});
  }
  document.point_arrays.push_back(make_data_array("motion", 3, motion));
}

std::vector<double> corners_xy(const MixedMesh& mesh, const MeshDocument& document) {
  std::vector<double> xy;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    xy.insert(xy.end(), {document.points[3 * v], document.points[3 * v + 1]});
  }
  return xy;
}

double smallest_shape(const MixedMesh& mesh, const MeshDocument& document) {
  const std::vector<double> xy = corners_xy(mesh, document);
  double least = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    least = std::min(least, mixed_meshes::shape_by_definition(mesh, e, xy));
  }
  return least;
}

TEST_CASE("quadrilaterals of a file follow its boundary, alone and beside triangles") {
  const ScratchFolder folder;
  const MixedMesh mesh = grid(GENERATE(0, 1));
  MeshDocument document = document_of(mesh);
  add_motion(mesh, document);
  const std::string input = (folder / "in.vtu").string();
  const std::string output = (folder / "out.vtu").string();
  write_mesh(input, document);
  const Outcome outcome = deform({input, output, "--displacement", "motion", "--require",
                                  "quadrilateral.min_shape>=0.3", "--report", (folder / "report.json").string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_FALSE(outcome.says("held: "));
  const MeshDocument after = read_mesh(output);
  CHECK(smallest_shape(mesh, after) > 0.3);
  std::size_t inside = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::size_t column = v % (width + 1);
    const std::size_t row = v / (width + 1);
    if (column % width == 0 || row % width == 0) {
      CHECK(after.points[3 * v] == document.points[3 * v]);
      CHECK(after.points[3 * v + 1] == document.points[3 * v + 1] + rise_of(mesh, v));
    } else {
      inside += after.points[3 * v + 1] != document.points[3 * v + 1] ? 1 : 0;
    }
  }
  CHECK(inside > std::size_t{width} * width / 2);
  const nlohmann::json report = nlohmann::json::parse(bytes_of(folder / "report.json"));
  CHECK(report["deformation"]["steps"][0]["min_shape"].get<double>() == Approx(smallest_shape(mesh, after)));
}

TEST_CASE("quadrilaterals that are held do not follow, and what they become is told with the way out") {
  const ScratchFolder folder;
  const MixedMesh mesh = grid(1);
  MeshDocument document = document_of(mesh);
  std::vector<double> motion;
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    // Told to fold: columns in turn go up and down by more than an edge.
    motion.insert(motion.end(), {0, v % 2 == 0 ? 1.5 : -1.5, 0});
  }
  document.point_arrays.push_back(make_data_array("motion", 3, motion));
  write_mesh(folder / "in.vtu", document);
  const Outcome outcome = deform(
      {(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement", "motion", "--quads", "hold"});
  CHECK(outcome.code == 0);
  CHECK(outcome.says("that are held are folded"));
  CHECK(outcome.says("without --quads hold they follow the boundary"));
}

TEST_CASE("quadrilaterals of nine nodes follow: middles inside with their sides, centres with their corners") {
  const ScratchFolder folder;
  const MixedMesh mesh = grid(0);
  MeshDocument document = document_of(mesh);
  document.cells = {};
  std::vector<std::array<std::int32_t, 3>> sides;  ///< two corners, and the middle
  const auto middle_of = [&](std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    for (const auto& [one, other, middle] : sides) {
      if (one == low && other == high) {
        return middle;
      }
    }
    const auto middle = static_cast<std::int32_t>(document.point_count());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      document.points.push_back((document.points[3 * static_cast<std::size_t>(low) + axis] +
                                 document.points[3 * static_cast<std::size_t>(high) + axis]) /
                                2);
    }
    sides.push_back({low, high, middle});
    return middle;
  };
  std::vector<std::int32_t> centres;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    std::vector<std::int32_t> nodes = mesh.corners(e);
    for (std::size_t i = 0; i < 4; ++i) {
      nodes.push_back(middle_of(nodes[i], nodes[(i + 1) % 4]));
    }
    centres.push_back(static_cast<std::int32_t>(document.point_count()));
    nodes.push_back(centres.back());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        sum += document.points[3 * static_cast<std::size_t>(nodes[i]) + axis];
      }
      document.points.push_back(sum / 4);
    }
    document.cells.append(cell_type::biquadratic_quad, nodes);
  }
  write_mesh(folder / "in.vtu", document);
  std::string table;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (v % (width + 1) % width == 0 || v / (width + 1) % width == 0) {
      table += std::to_string(v) + " 0 " + std::to_string(rise_of(mesh, v)) + "\n";
    }
  }
  for (const std::int32_t centre : centres) {  // are told to go elsewhere
    table += std::to_string(centre) + " 5 5\n";
  }
  const std::string told = folder.write("told.csv", table).string();
  const Outcome outcome =
      deform({(folder / "in.vtu").string(), (folder / "out.vtu").string(), "--displacement-file", told});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.says("the 100 displacements of vertices inside are not obeyed"));
  const MeshDocument after = read_mesh(folder / "out.vtu");
  CHECK(smallest_shape(mesh, after) > 0.3);
  const auto at = [&](std::int32_t v, std::size_t axis) {
    return after.points[3 * static_cast<std::size_t>(v) + axis];
  };
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const auto& [a, b, middle] : sides) {
      REQUIRE(at(middle, axis) == Approx((at(a, axis) + at(b, axis)) / 2).margin(1e-12));
    }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      double sum = 0;
      for (const std::int32_t v : mesh.corners(e)) {
        sum += at(v, axis);
      }
      REQUIRE(at(centres[e], axis) == Approx(sum / 4).margin(1e-12));
    }
  }
}

}  // namespace trismooth::deform_quadrilaterals_test
