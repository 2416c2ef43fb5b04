// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_groups.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/empty_groups.h"

#include "catch.h"

using trismooth::CellGroup;
using trismooth::find_cell_groups;
using trismooth::make_data_array;
using trismooth::MeshDocument;

namespace {

namespace type = trismooth::cell_type;

/// Two lines and three triangles.
MeshDocument document() {
  MeshDocument document;
  document.points.resize(12);
  document.cells.append(type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(type::line, std::vector<std::int32_t>{1, 2});
  for (int i = 0; i < 3; ++i) {
    document.cells.append(type::triangle, std::vector<std::int32_t>{0, 1, i + 1});
  }
  return document;
}

void add(MeshDocument& document, std::string name, std::vector<std::int32_t> values,
         std::vector<trismooth::ValueName> names = {}) {
  document.cell_arrays.push_back(make_data_array(std::move(name), 1, std::move(values)));
  if (!names.empty()) {
    trismooth::ArrayDescription description;
    description.value_names = std::move(names);
    document.cell_arrays.back().description = std::make_shared<trismooth::ArrayDescription>(description);
  }
}

std::vector<std::string> texts(const std::vector<CellGroup>& groups) {
  std::vector<std::string> texts;
  for (const CellGroup& group : groups) {
    texts.push_back(std::to_string(group.dimension) + ":" + std::to_string(group.number) + ":" + group.name);
  }
  return texts;
}

}  // namespace

TEST_CASE("a document without an array of regions has no groups") {
  MeshDocument plain = document();
  CHECK(find_cell_groups(plain).arrays.text().empty());
  CHECK(find_cell_groups(plain).of_cell.empty());
  add(plain, "pressure", {1, 2, 3, 4, 5});
  plain.cell_arrays.push_back(make_data_array("region", 1, std::vector<double>{1, 1, 2, 2, 3}));
  plain.cell_arrays.push_back(make_data_array("region", 2, std::vector<std::int32_t>(10)));
  CHECK(find_cell_groups(plain).groups.empty());
}

TEST_CASE("groups are told apart by the dimension of their cells, and named by it") {
  MeshDocument named = document();
  add(named, "region", {1, 1, 1, 2, 2});
  add(named, "gmsh:physical", {7, 5, 5, 5, 0}, {{5, 1, "inlet"}, {5, 2, "air"}, {9, 2, "unused"}});
  const auto found = find_cell_groups(named);
  CHECK(found.arrays.text() == "gmsh:physical");
  CHECK(texts(found.groups) == std::vector<std::string>{"1:5:inlet", "1:7:", "2:5:air", "2:9:unused"});
  CHECK(found.of_cell == std::vector<std::int32_t>{1, 0, 2, 2, -1});
}

TEST_CASE("without names the first array that has regions by its name counts; 0 is none beside others") {
  MeshDocument unnamed = document();
  add(unnamed, "order", {1, 2, 3, 4, 5});
  add(unnamed, "Material ID", {0, 0, 0, 3, -2});
  const auto found = find_cell_groups(unnamed);
  CHECK(found.arrays.text() == "Material ID");
  CHECK(texts(found.groups) == std::vector<std::string>{"1:0:", "2:-2:", "2:3:"});
  CHECK(found.of_cell == std::vector<std::int32_t>{0, 0, -1, 2, 1});
}

TEST_CASE("lines that the array of regions does not tell apart are grouped by the one that has values of lines alone") {
  MeshDocument tagged = document();
  add(tagged, "order", {1, 2, 3, 4, 5});
  add(tagged, "material", {0, 0, 7, 9, 7});
  add(tagged, "ghosts of lines", {1, 1, 0, 0, 0});
  add(tagged, "bottom", {7, 0, 0, 0, 0});
  add(tagged, "top", {0, 4, 0, 0, 0});
  const auto found = find_cell_groups(tagged);
  CHECK(found.arrays.of_dimension == std::array<std::string, 4>{"material", "bottom", "material", "material"});
  CHECK(found.arrays.text() == "material, bottom");
  CHECK((found.arrays.has("bottom") && !found.arrays.has("top") && !found.arrays.has("")));
  CHECK(texts(found.groups) == std::vector<std::string>{"1:7:bottom_7", "2:7:material_7", "2:9:material_9"});
  CHECK(found.of_cell == std::vector<std::int32_t>{0, -1, 1, 2, 1});
}

TEST_CASE("lines are grouped by their own array where none has regions, and by that of regions where it tells them") {
  MeshDocument sides = document();
  add(sides, "bottom", {3, 5, 0, 0, 0});
  CHECK(texts(find_cell_groups(sides).groups) == std::vector<std::string>{"1:3:bottom_3", "1:5:bottom_5"});
  add(sides, "material", {1, 0, 7, 7, 7});
  CHECK(texts(find_cell_groups(sides).groups) == std::vector<std::string>{"1:1:", "2:7:"});
}

TEST_CASE("a group that the file names and no cell is in is empty, unless a set has its cells") {
  MeshDocument named = document();
  add(named, "region", {1, 1, 2, 2, 3}, {{1, 1, "wall"}, {4, 1, "spare"}, {3, 2, "c"}, {5, 2, "whole"}});
  named.cell_sets = {{"whole", {2, 3}}, {"later", {}}};
  named.point_sets = {{"nowhere", {}}, {"corner", {0}}};
  const auto groups = find_cell_groups(named).groups;
  CHECK(texts(groups) == std::vector<std::string>{"1:1:wall", "1:4:spare", "2:2:", "2:3:c"});
  CHECK(groups[1].is_empty);
  CHECK(std::ranges::count(groups, true, &CellGroup::is_empty) == 1);
  CHECK(trismooth::names_of_empty_groups(named) == std::vector<std::string>{"spare", "later", "nowhere"});
  const MeshDocument without = trismooth::without_empty_groups(named);
  CHECK(trismooth::names_of_empty_groups(without).empty());
  CHECK(without.cell_sets.size() == 1);
  CHECK(without.point_sets.size() == 1);
  CHECK(without.cell_arrays[0].description->value_names.size() == 3);
}
