// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_groups.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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
  CHECK(find_cell_groups(plain).array.empty());
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
  CHECK(found.array == "gmsh:physical");
  CHECK(texts(found.groups) == std::vector<std::string>{"1:5:inlet", "1:7:", "2:5:air"});
  CHECK(found.of_cell == std::vector<std::int32_t>{1, 0, 2, 2, -1});
}

TEST_CASE("without names the first array that has regions by its name counts; 0 is none beside others") {
  MeshDocument unnamed = document();
  add(unnamed, "order", {1, 2, 3, 4, 5});
  add(unnamed, "Material ID", {0, 0, 0, 3, -2});
  const auto found = find_cell_groups(unnamed);
  CHECK(found.array == "Material ID");
  CHECK(texts(found.groups) == std::vector<std::string>{"1:0:", "2:-2:", "2:3:"});
  CHECK(found.of_cell == std::vector<std::int32_t>{0, 0, -1, 2, 1});
}
