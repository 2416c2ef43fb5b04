// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/warnings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/mixed_document.h"
#include "support/mixed_meshes.h"
#include "support/says.h"
#include "support/scratch_folder.h"

namespace trismooth::warnings_test {

TEST_CASE("options that the method or the way of sliding takes no notice of are named") {
  PipelineOptions options;
  CHECK(warning_of_options_without_effect(options).empty());
  options.slide.along = Slide::straight;
  CHECK(warning_of_options_without_effect(options).empty());
  options.slide.curve = SlideCurve::spline;
  CHECK(warning_of_options_without_effect(options) ==
        "--slide straight takes no notice of --curve; --slide curves does");
  options.slide.deviation = 0.01;
  options.smoothing.mean_ratio.power = 2;
  CHECK(warning_of_options_without_effect(options) ==
        "the method smart takes no notice of --power; --method mean-ratio does; --slide straight takes no notice of "
        "--deviation, --curve; --slide curves does");
  options.slide.along = Slide::curves;
  options.smoothing.method = Method::mean_ratio;
  CHECK(warning_of_options_without_effect(options).empty());
}

TEST_CASE("a quality that was asked for and not reached is told, with the reason") {
  PipelineOptions options;
  PipelineResult result;
  result.after.emplace();
  (*result.after)[Metric::shape].min = 0.5;
  result.smoothing.emplace();
  result.smoothing->stop_reason = StopReason::sweep_limit;
  CHECK(note_of_missed_target(options, result).empty());
  options.smoothing.target_quality = 0.5;
  CHECK(note_of_missed_target(options, result).empty());
  options.smoothing.target_quality = 0.75;
  CHECK(note_of_missed_target(options, result) ==
        "the smallest shape is 0.5 and not 0.75, which --target-quality asks for: the sweep limit was reached");
}

TEST_CASE("sizes so far from those of the mesh that nothing moves are told") {
  const ScratchFolder folder;
  trismooth::MeshDocument document =
      document_of(trismooth::random_delaunay_mesh(400, 3, {trismooth::GeneratedBoundary::resolved}));
  std::vector<double> sizes(document.point_count());
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    sizes[v] = v % 2 == 0 ? 1e-12 : 1e12;
  }
  document.point_arrays.push_back(trismooth::make_data_array("h", 1, sizes));
  PipelineOptions options;
  options.input = folder / "mesh.vtk";
  options.output = folder / "out.vtk";
  options.smoothing.method = Method::mean_ratio;
  trismooth::write_mesh(options.input, document);
  const auto is_warned = [](const PipelineResult& result) {
    return std::ranges::any_of(result.warnings, [](const std::string& warning) {
      return says(warning, "no vertex moved: the sizes of 'h' are too far from those of the mesh");
    });
  };
  CHECK_FALSE(is_warned(trismooth::run_pipeline(options)));
  options.size_array = "h";
  options.smoothing.mean_ratio.size_weight = 1e6;
  const PipelineResult result = trismooth::run_pipeline(options);
  CHECK(is_warned(result) == (result.smoothing->moved_vertices == 0));
  CHECK(is_warned(result));
}

/// Some of the triangles joined to quadrilaterals, where two of them make a convex one.
std::vector<mixed_meshes::Element> some_joined(const RandomMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> by_side;  // those that are alone still
  std::vector<mixed_meshes::Element> elements;
  const auto turns_left = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto at = [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
    return cross(at(b) - at(a), at(c) - at(b)) > 0;
  };
  for (const auto& corners : mesh.triangles) {
    bool is_joined = false;
    for (std::size_t i = 0; i < 3 && !is_joined; ++i) {
      const std::int32_t a = corners[i];
      const std::int32_t b = corners[(i + 1) % 3];
      const std::int32_t c = corners[(i + 2) % 3];
      const auto found = by_side.find({b, a});
      if (found == by_side.end() || elements[found->second][3] >= 0) {
        continue;
      }
      const mixed_meshes::Element other = elements[found->second];
      const std::int32_t d = other[0] + other[1] + other[2] - a - b;
      if (turns_left(c, a, d) && turns_left(a, d, b) && turns_left(d, b, c) && turns_left(b, c, a)) {
        elements[found->second] = {c, a, d, b};
        is_joined = true;
      }
    }
    for (std::size_t i = 0; i < 3 && !is_joined; ++i) {
      by_side[{corners[i], corners[(i + 1) % 3]}] = elements.size();
    }
    if (!is_joined) {
      elements.push_back({corners[0], corners[1], corners[2], -1});
    }
  }
  return elements;
}

/// Whether what a note of the growth bound says of that mesh is so, by the definitions: which cell, of which shape, and
/// what would become of the elements around the vertex in the mean of its neighbours.
void check_growth_note(const std::string& note, const mixed_meshes::MixedMesh& mesh, std::vector<double> xy) {
  const std::regex form(".* of shape ([0-9.e-]+) in cell ([0-9]+): vertex ([0-9]+) .* would have ([0-9.e-]+), .*");
  std::smatch said;
  REQUIRE(std::regex_match(note, said, form));
  CHECK(mixed_meshes::shape_by_definition(mesh, std::stoul(said[2]), xy) == Approx(std::stod(said[1])).epsilon(0.01));
  const auto vertex = std::stoul(said[3]);
  std::set<std::size_t> neighbours;
  std::vector<std::size_t> around;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::vector<std::int32_t> corners = mesh.corners(e);
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (corners[i] == static_cast<std::int32_t>(vertex)) {
        around.push_back(e);
        neighbours.insert({static_cast<std::size_t>(corners[(i + 1) % count]),
                           static_cast<std::size_t>(corners[(i + count - 1) % count])});
      }
    }
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double sum = 0;
    for (const std::size_t v : neighbours) {
      sum += xy[2 * v + axis];
    }
    xy[2 * vertex + axis] = sum / static_cast<double>(neighbours.size());
  }
  double smallest = 1;
  for (const std::size_t e : around) {
    smallest = std::min(smallest, mixed_meshes::shape_by_definition(mesh, e, xy));
  }
  CHECK(smallest == Approx(std::stod(said[4])).epsilon(0.01));
}

TEST_CASE("the growth bound is named where it keeps the worst element from what smart does for it, and only there") {
  for (const bool joins : {false, true}) {
    std::size_t told = 0;
    std::size_t of_quadrilaterals = 0;
    for (const auto boundary : {trismooth::GeneratedBoundary::random, trismooth::GeneratedBoundary::resolved}) {
      for (std::uint64_t seed = 1; seed <= (joins ? 12 : 6); ++seed) {
        CAPTURE(seed, boundary, joins);
        const RandomMesh random = trismooth::random_delaunay_mesh(joins ? 1000 : 200, seed, {boundary});
        trismooth::MeshDocument document = document_of(random);
        mixed_meshes::MixedMesh mesh;
        if (joins) {
          mesh.elements = some_joined(random);
          for (const auto& [x, y] : random.points) {
            mesh.points.push_back({x, y});
          }
          document = document_of(mesh);
        }
        PipelineOptions options;
        options.smoothing.method = Method::mean_ratio;
        const PipelineResult result = smooth_document(document, options);
        const auto note = std::ranges::find_if(result.notes, [](const std::string& sentence) {
          return sentence.starts_with("the growth bound of mean-ratio keeps");
        });
        const bool is_told = note != result.notes.end();
        told += is_told ? 1 : 0;
        if (is_told && joins) {
          std::vector<double> xy;
          for (std::size_t v = 0; v < document.point_count(); ++v) {
            xy.insert(xy.end(), {document.points[3 * v], document.points[3 * v + 1]});
          }
          check_growth_note(*note, mesh, xy);
          const std::string cell = note->substr(note->find("in cell ") + 8);
          of_quadrilaterals += mesh.is_triangle(std::stoul(cell)) ? 0 : 1;
        }
        if (is_told) {
          // What is said there can be had.
          options.smoothing.method = Method::smart;
          options.smoothing.max_sweeps = 1;
          const PipelineResult smart = smooth_document(document, options);
          CHECK(smart.smoothing->moved_vertices > 0);
        }
        CHECK((!is_told || boundary == trismooth::GeneratedBoundary::random));
      }
    }
    CHECK(told > 0);
    CHECK((of_quadrilaterals > 0) == joins);
  }
}

TEST_CASE("a vertex that comes back from far away leaves nothing worse in the report, which says what it cannot see") {
  const auto smoothed = [](double far) {
    trismooth::MeshDocument document;
    constexpr int side = 5;
    for (int v = 0; v < side * side; ++v) {
      const int row = v / side;
      document.points.insert(document.points.end(), {v % side + 0.2 * (v % 3), v == 12 ? far : row + 0.1 * (v % 2), 0});
    }
    for (int v = 0; v + side + 1 < side * side; ++v) {
      if (v % side + 1 < side) {
        document.cells.append(trismooth::cell_type::quad, trismooth::MixedElement{v, v + 1, v + side + 1, v + side});
      }
    }
    PipelineOptions options;
    options.smoothing.method = Method::laplacian;
    return smooth_document(document, options);
  };
  for (const double far : {1e6, 1e40, 1e180, 1e300}) {
    CAPTURE(far);
    const PipelineResult result = smoothed(far);
    CHECK(result.smoothing->moved_vertices > 0);
    CHECK(result.after->inverted + result.after->degenerate <= result.before.inverted + result.before.degenerate);
    const bool is_told = std::ranges::any_of(result.warnings, [](const std::string& warning) {
      return says(warning, "times smaller than before, since a vertex came back from far away");
    });
    CHECK(is_told == (far > 1e30));
  }
}

TEST_CASE("sizes are compared where corners slide, too") {
  // Two rows of vertices: all are on the boundary.
  const auto compared = [](Slide slide) {
    trismooth::MeshDocument document;
    for (int i = 0; i < 6; ++i) {
      const double off = i == 0 || i == 5 ? 0 : 0.2 * (i % 3 - 1);
      document.points.insert(document.points.end(), {i + off, 0, 0, i - off, 1, 0});
    }
    for (int i = 0; i < 10; i += 2) {
      document.cells.append(trismooth::cell_type::triangle, trismooth::Triangle{i, i + 2, i + 1});
      document.cells.append(trismooth::cell_type::triangle, trismooth::Triangle{i + 1, i + 2, i + 3});
    }
    document.point_arrays.push_back(trismooth::make_data_array("h", 1, std::vector<double>(12, 1.0)));
    PipelineOptions options;
    options.smoothing.method = Method::mean_ratio;
    options.size_array = "h";
    options.slide.along = slide;
    return smooth_document(document, options).size_fit_after->elements;
  };
  CHECK(compared(Slide::off) == 0);
  CHECK(compared(Slide::straight) == 10);
}

}  // namespace trismooth::warnings_test
