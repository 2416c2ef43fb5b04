// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/size_array.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/pipeline/input/regions.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::size_array_test {

/// Two triangles of five points, one of which is in none, and a line between them.
struct Sample {
  MeshDocument document;
  PlanarMesh mesh;

  Sample() {
    document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 5, 5, 0};
    for (std::size_t v = 0; v < 5; ++v) {
      mesh.points.push_back({document.points[3 * v], document.points[3 * v + 1]});
    }
    mesh.list(std::vector<trismooth::Triangle>{{0, 1, 2}, {0, 2, 3}});
    mesh.cells = {0, 2};
  }
  void at_points(std::string name, const std::vector<double>& values) {
    document.point_arrays.push_back(make_data_array(std::move(name), values.size() / 5, values));
  }
  void at_cells(std::string name, const std::vector<float>& values) {
    document.cell_arrays.push_back(make_data_array(std::move(name), values.size() / 3, values));
  }
  std::string message(const std::string& name) const {
    return message_of<std::invalid_argument>([&] { find_size_array(document, mesh, name); });
  }
};

TEST_CASE("an array at points has the edge lengths, and what is in no triangle does not count") {
  Sample sample;
  sample.at_points("Edge length", {1, 2, 3, 4, -5});
  const SizeArray sizes = find_size_array(sample.document, sample.mesh, "edge_length");
  CHECK(sizes.array == "Edge length");
  CHECK_FALSE(sizes.of_cells);
  CHECK(sizes.lengths == std::vector<double>{1, 2, 3, 4, 0});
}

TEST_CASE("an array of cells has the areas: vertices get the edges of the mean of the triangles around") {
  Sample sample;
  sample.at_cells("area", {1, -7, 4});
  const SizeArray sizes = find_size_array(sample.document, sample.mesh, "area");
  CHECK(sizes.of_cells);
  const auto edge = [](double area) { return std::sqrt(4 * area / std::numbers::sqrt3); };
  const std::vector<double> areas{2.5, 1, 2.5, 4};
  for (std::size_t v = 0; v < 4; ++v) {
    CHECK(sizes.lengths[v] / sizes.lengths[1] == Approx(edge(areas[v]) / edge(1)));
  }
  CHECK(sizes.lengths[4] == 0);
  Sample large;
  large.at_cells("area", {1e38F, 1, 3e38F});
  CHECK(std::isfinite(find_size_array(large.document, large.mesh, "area").lengths[0]));
}

TEST_CASE("a strip's area is that of all its triangles") {
  Sample strip;
  strip.mesh.cells = {1, 1};
  strip.at_cells("area", {9, 6, 9});
  Sample singly;
  singly.mesh.cells = {0, 1};
  singly.at_cells("area", {3, 3, 9});
  CHECK(find_size_array(strip.document, strip.mesh, "area").lengths ==
        find_size_array(singly.document, singly.mesh, "area").lengths);
}

TEST_CASE("of two arrays of a name that at points counts") {
  Sample sample;
  sample.at_cells("h", {9, 9, 9});
  sample.at_points("h", {1, 2, 3, 4, 5});
  CHECK(find_size_array(sample.document, sample.mesh, "h").lengths[1] == 2);
}

TEST_CASE("an array of the very name goes before one whose name differs in case, at points or of cells") {
  Sample sample;
  sample.at_points("H", {1, 2, 3, 4, 5});
  sample.at_points("h_", {6, 7, 8, 9, 1});
  sample.at_cells("h", {9, 9, 9});
  CHECK(find_size_array(sample.document, sample.mesh, "h").of_cells);
  CHECK(find_size_array(sample.document, sample.mesh, "H").lengths[1] == 2);
  CHECK(find_size_array(sample.document, sample.mesh, "h_").lengths[1] == 7);
  CHECK(find_size_array(sample.document, sample.mesh, "h ").array == "H");
  sample.document.cell_labels.push_back(
      trismooth::make_label_array("_h", std::vector<std::string_view>{"a", "b", "a"}));
  CHECK(sample.message("_h") == "the cell array '_h' holds texts; sizes must be positive numbers");
}

TEST_CASE("what is no array of sizes is refused in words") {
  Sample sample;
  sample.at_points("h", {1, 2, 3, 4, 5});
  sample.at_points("zero", {1, 2, 0, -4, 5});
  sample.at_points("velocity", std::vector<double>(15, 1));
  sample.at_cells("area", {1, 1, std::numeric_limits<float>::quiet_NaN()});
  sample.document.cell_labels.push_back(
      trismooth::make_label_array("name", std::vector<std::string_view>{"a", "b", "a"}));
  CHECK(sample.message("size") ==
        "the file has no point or cell array 'size' to take sizes from; it has: h, zero, "
        "velocity at points, area at cells");
  CHECK(sample.message("zero") == "the point array 'zero' is 0 at point 2; sizes must be positive numbers");
  CHECK(sample.message("area") == "the cell array 'area' is nan at cell 2; sizes must be positive numbers");
  CHECK(sample.message("velocity") == "the point array 'velocity' has 3 components; sizes need one");
  CHECK(sample.message("name") == "the cell array 'name' holds texts; sizes must be positive numbers");
  CHECK(Sample().message("h") ==
        "the file has no point or cell array 'h' to take sizes from; it has: none at points, none at cells");
}

TEST_CASE("an array of sizes is not taken for regions, unless it is named for that, too") {
  Sample sample;
  // A strip of four triangles.
  sample.document.points = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
  sample.mesh.points = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  sample.mesh.list(std::vector<trismooth::Triangle>{{0, 2, 1}, {2, 3, 1}, {2, 4, 3}, {4, 5, 3}});
  sample.mesh.cells = {0, 1, 2, 3};
  sample.document.cell_arrays.push_back(make_data_array("block", 1, std::vector<float>{1, 1, 2, 2}));
  CHECK(trismooth::find_regions(sample.document, sample.mesh).count() == 2);
  CHECK(trismooth::find_regions(sample.document, sample.mesh, {}, "block").count() == 0);
  const std::vector<std::string> named{"block"};
  CHECK(trismooth::find_regions(sample.document, sample.mesh, named, "block").count() == 2);
}

}  // namespace trismooth::size_array_test
