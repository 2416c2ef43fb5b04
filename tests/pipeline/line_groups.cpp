// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/line_groups.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "catch.h"

namespace trismooth::line_groups_test {

TEST_CASE("lines are counted by the names that the file has for their values") {
  MeshDocument document;
  document.points.assign(15, 0.0);
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{1, 2});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{2, 0});
  document.cells.append(cell_type::quadratic_edge, std::vector<std::int32_t>{2, 3, 4});
  document.cell_arrays.push_back(make_data_array("su2:marker", 1, std::vector<std::int32_t>{1, 1, 1, 2, 4}));
  ArrayDescription description;
  description.value_names = {{2, 1, "wall"}, {1, 1, "inlet"}, {1, 2, "steel"}, {3, 1, "unused"}};
  document.cell_arrays.back().description = std::make_shared<ArrayDescription>(std::move(description));
  document.cell_arrays.push_back(make_data_array("other", 1, std::vector<std::int32_t>{9, 9, 9, 9, 9}));
  const auto groups = find_line_groups(document);
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].name == "wall");
  CHECK(groups[0].vertices == 2);
  CHECK(groups[1].name == "inlet");
  CHECK(groups[1].vertices == 3);
  CHECK(groups[2].name == "unused");
  CHECK(groups[2].vertices == 0);
}

}  // namespace trismooth::line_groups_test
