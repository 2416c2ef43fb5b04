// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"
#include "trismooth/pipeline/pipeline.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::smooth_document_test {

/// A mesh of regions in a file.
std::filesystem::path example_file() {
  return std::filesystem::path(TRISMOOTH_EXAMPLE_DATA) / "farfield.vtk";
}

PipelineOptions options_for(const std::filesystem::path& input) {
  PipelineOptions options;
  options.input = input;
  options.smoothing.method = trismooth::Method::mean_ratio;
  return options;
}

TEST_CASE("a mesh that was read is smoothed and written as a run from file to file does it") {
  const std::filesystem::path input = example_file();
  const ScratchFolder folder;
  PipelineOptions run = options_for(input);
  run.output = folder / "run.vtk";
  const PipelineResult expected = trismooth::run_pipeline(run);

  MeshDocument document = trismooth::read_mesh(input);
  const PipelineResult result = trismooth::smooth_document(document, options_for(input));
  trismooth::write_mesh(folder / "document.vtk", document);
  CHECK(bytes_of(folder / "document.vtk") == bytes_of(folder / "run.vtk"));
  CHECK(result.coordinates_hash == expected.coordinates_hash);
  CHECK(result.notes == expected.notes);
  CHECK(result.input.fixed_vertices == expected.input.fixed_vertices);
  REQUIRE(result.after);
  CHECK(result.after->metrics[0].min == expected.after->metrics[0].min);

  const PipelineResult check = trismooth::check_document(document, options_for(input));
  CHECK(check.before.metrics[0].mean == expected.after->metrics[0].mean);
  CHECK_FALSE(check.smoothing);
}

TEST_CASE("a mesh that cannot be smoothed as asked for is as it was") {
  const std::filesystem::path input = example_file();
  MeshDocument document = trismooth::read_mesh(input);
  const std::vector<double> points = document.points;
  const auto is_untouched = [&] {
    const MeshDocument again = trismooth::read_mesh(input);
    return document.points == points && document.cells.connectivity == again.cells.connectivity &&
           document.cell_arrays.size() == again.cell_arrays.size() && document.original != nullptr;
  };
  PipelineOptions options = options_for(input);
  SECTION("an array that is not there") {
    options.region_arrays = {"none such"};
    CHECK_THROWS_AS(trismooth::smooth_document(document, options), std::invalid_argument);
  }
  SECTION("a vertex that is not there") {
    options.fixed_vertices = {3, static_cast<std::int32_t>(document.point_count())};
    CHECK_THROWS_WITH(trismooth::smooth_document(document, options), Catch::Contains("fixed: vertex"));
  }
  SECTION("stopped") {
    options.smoothing.progress = [](const trismooth::SweepRecord&) { return trismooth::Progress::stop; };
    CHECK_THROWS_AS(trismooth::smooth_document(document, options), trismooth::Cancelled);
  }
  SECTION("in no plane") {
    document.points[2] = 1;
    CHECK_THROWS_AS(trismooth::smooth_document(document, options), trismooth::ReadError);
    document.points[2] = points[2];
  }
  CHECK(is_untouched());
}

TEST_CASE("vertices named by number are held beside those of the file") {
  const std::filesystem::path input = example_file();
  MeshDocument free = trismooth::read_mesh(input);
  MeshDocument held = trismooth::read_mesh(input);
  const std::vector<double> before = free.points;
  trismooth::smooth_document(free, options_for(input));
  const auto stays = [&before](const MeshDocument& document, std::int32_t v) {
    return std::equal(before.begin() + 3 * v, before.begin() + 3 * v + 3, document.points.begin() + 3 * v);
  };
  PipelineOptions options = options_for(input);
  for (std::int32_t v = 0; options.fixed_vertices.size() < 100; ++v) {
    if (!stays(free, v)) {
      options.fixed_vertices.push_back(v);
    }
  }
  const PipelineResult result = trismooth::smooth_document(held, options);
  CHECK(result.input.held.named == 100);
  CHECK(std::ranges::all_of(options.fixed_vertices, [&](std::int32_t v) { return stays(held, v); }));
  CHECK(held.points != before);
}

}  // namespace trismooth::smooth_document_test
