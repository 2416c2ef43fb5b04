// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/errors.h"
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

/// A square of four triangles around a vertex, made by hand.
MeshDocument square() {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.9, 0.8, 0};
  for (const trismooth::Triangle& t : std::vector<trismooth::Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}) {
    document.cells.append(trismooth::cell_type::triangle, t);
  }
  document.cell_arrays = {trismooth::make_data_array("material", 1, std::vector<std::int32_t>{1, 1, 1, 1})};
  document.point_arrays = {trismooth::make_data_array("load", 1, std::vector<double>(5, 1))};
  document.point_sets = {{"corners", {0, 1, 2, 3}}};
  return document;
}

TEST_CASE("a mesh that the program has made is smoothed and written") {
  MeshDocument document = square();
  const PipelineResult result = trismooth::smooth_document(document, {});
  CHECK(result.smoothing->moved_vertices == 1);
  CHECK(document.points[12] == 0.5);
  CHECK(document.points[13] == 0.5);
  const ScratchFolder folder;
  trismooth::write_mesh(folder / "square.vtu", document);
  CHECK(trismooth::read_mesh(folder / "square.vtu").points == document.points);
}

TEST_CASE("a mesh that the program has made and that is not sound is refused, and nothing is written of it") {
  struct Fault {
    std::string message;
    std::function<void(MeshDocument&)> make;
  };
  const std::vector<Fault> faults{
      {"cell 3 names vertex -1; vertices are numbered from 0 to 4",
       [](MeshDocument& d) { d.cells.connectivity[9] = -1; }},
      {"cell 1 names vertex 5000000; vertices are numbered from 0 to 4",
       [](MeshDocument& d) { d.cells.connectivity[5] = 5000000; }},
      {"cells: offsets has 4 entries, expected one for each of 5 cells, and one more",
       [](MeshDocument& d) { d.cells.offsets.pop_back(); }},
      {"cells: offsets go from 0 up to the number of entries of connectivity",
       [](MeshDocument& d) { d.cells.offsets[1] = 700; }},
      {"points: 14 numbers, expected 3 for each point", [](MeshDocument& d) { d.points.pop_back(); }},
      {"vertex 4 has a coordinate that is not finite", [](MeshDocument& d) { d.points[13] = std::nan(""); }},
      {"the array 'material' has 2 entries, expected one for each of 4 cells",
       [](MeshDocument& d) {
         d.cell_arrays[0] = trismooth::make_data_array("material", 1, std::vector{1, 2});
       }},
      {"the array 'load' has 6 entries, expected one for each of 5 points",
       [](MeshDocument& d) { d.point_arrays[0] = trismooth::make_data_array("load", 1, std::vector<double>(6)); }},
      {"the set 'corners' names point 5, of 5", [](MeshDocument& d) { d.point_sets[0].members.push_back(5); }},
      {"the set 'all' names cell -3, of 4",
       [](MeshDocument& d) {
         d.cell_sets = {{"all", {0, -3}}};
       }},
      {"a periodic pair names point 9, of 5",
       [](MeshDocument& d) {
         d.periodic_pairs = {{0, 9}};
       }},
      {"point_labels has 2 entries, expected one for each of 5 points", [](MeshDocument& d) {
         d.point_labels = {7, 8};
       }}};
  const ScratchFolder folder;
  for (const Fault& fault : faults) {
    INFO(fault.message);
    MeshDocument document = square();
    fault.make(document);
    const std::vector<double> points = document.points;
    CHECK(message_of<trismooth::MeshError>([&] { trismooth::smooth_document(document, {}); }) == fault.message);
    CHECK(message_of<trismooth::MeshError>([&] { trismooth::check_document(document, {}); }) == fault.message);
    CHECK(std::memcmp(points.data(), document.points.data(), points.size() * sizeof(double)) == 0);
    CHECK_THROWS_AS(trismooth::write_mesh(folder / "unsound.vtu", document), trismooth::WriteError);
    CHECK_FALSE(std::filesystem::exists(folder / "unsound.vtu"));
  }
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
