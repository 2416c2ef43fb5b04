// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/label_array.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "catch.h"

TEST_CASE("texts become places in a list that has each of them once") {
  const std::vector<std::string_view> texts{"steel", "air", "", "steel", "air"};
  const trismooth::LabelArray array = trismooth::make_label_array("names", texts);
  CHECK(array.name == "names");
  CHECK(array.labels == std::vector<std::string>{"", "air", "steel"});
  CHECK(array.of_row == std::vector<std::int32_t>{2, 1, 0, 2, 1});
  CHECK(trismooth::make_label_array("none", {}).labels.empty());
}
