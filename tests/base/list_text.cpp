// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/list_text.h"

#include <string>
#include <vector>

#include "catch.h"

namespace trismooth::list_text_test {

TEST_CASE("a list has what a function says of its items, with the same between all of them") {
  const std::vector<std::string> items{"a", "b", "c"};
  CHECK(list_text(items) == "a, b, c");
  CHECK(list_text(
            items, [](const std::string& item) { return "'" + item + "'"; }, " and ") == "'a' and 'b' and 'c'");
  CHECK(list_text(std::vector<std::string>{}).empty());
}

TEST_CASE("a list that is added to is the same one") {
  std::string list;
  add_to_list(list, "a");
  CHECK(list == "a");
  add_to_list(list, "b");
  add_to_list(list, "c", "; ");
  CHECK(list == "a, b; c");
}

TEST_CASE("of a long list the first items are told, and that there are more") {
  const std::vector<std::string> items{"a", "b", "c"};
  CHECK(first_of_list(items, 2) == "a, b, ...");
  CHECK(first_of_list(items, 3) == "a, b, c");
  CHECK(first_of_list(items, 9, [](const std::string& item) { return item + item; }) == "aa, bb, cc");
}

}  // namespace trismooth::list_text_test
