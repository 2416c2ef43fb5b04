// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/warnings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/generate/random_document.h"
#include "trismooth/pipeline/generate/random_mesh.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
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

TEST_CASE("what stays where lines touch is told, with what there is to do about it") {
  trismooth::SlidingResult sliding;
  trismooth::Sliding asked;
  CHECK(trismooth::note_of_touching_lines(sliding, asked).empty());
  sliding.in_same_place = 20;
  CHECK(trismooth::note_of_touching_lines(sliding, asked) ==
        "lines touch without sharing vertices, so these do not slide: 20 where others are, within a thousandth of an "
        "edge; --slide-coincident has those in the same place slide together, --merge DISTANCE, without --slide, joins "
        "vertices that nearly coincide");
  sliding.at_edges = 5;
  asked.coincident = true;
  CHECK(
      trismooth::note_of_touching_lines(sliding, asked) ==
      "lines touch without sharing vertices, so these do not slide: 20 where others are, within a thousandth of an "
      "edge, 5 within edges of others or at their ends; --merge DISTANCE, without --slide, joins vertices that nearly "
      "coincide");
  sliding.in_same_place = 0;
  asked.coincident = false;
  CHECK(trismooth::note_of_touching_lines(sliding, asked) ==
        "lines touch without sharing vertices, so these do not slide: 5 within edges of others or at their ends; "
        "--merge DISTANCE, without --slide, joins vertices that nearly coincide");
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

TEST_CASE("the growth bound is named where it keeps the worst element from what smart does for it, and only there") {
  std::size_t told = 0;
  for (const auto boundary : {trismooth::GeneratedBoundary::random, trismooth::GeneratedBoundary::resolved}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      CAPTURE(seed, boundary);
      trismooth::MeshDocument document = document_of(trismooth::random_delaunay_mesh(200, seed, {boundary}));
      PipelineOptions options;
      options.smoothing.method = Method::mean_ratio;
      const PipelineResult result = smooth_document(document, options);
      const bool is_told = std::ranges::any_of(result.notes, [](const std::string& note) {
        return note.starts_with("the growth bound of mean-ratio keeps");
      });
      told += is_told ? 1 : 0;
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
    return smooth_document(document, options).size_fit_after->triangles;
  };
  CHECK(compared(Slide::off) == 0);
  CHECK(compared(Slide::straight) == 10);
}

}  // namespace trismooth::warnings_test
