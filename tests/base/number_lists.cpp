// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/number_lists.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "catch.h"

namespace trismooth::number_lists_test {

TEST_CASE("each number has the entries that it was given, in their order") {
  const std::vector<std::pair<std::int32_t, std::int32_t>> pairs{{7, 3}, {5, 1}, {7, 2}, {5, 9}, {7, 3}};
  const NumberLists lists(5, 9, pairs);
  const auto list = [&](std::int32_t number) { return std::vector(lists[number].begin(), lists[number].end()); };
  CHECK(list(5) == std::vector{1, 9});
  CHECK(list(6).empty());
  CHECK(list(7) == std::vector{3, 2, 3});
  CHECK(list(8).empty());
}

TEST_CASE("lists of nothing are empty, whatever the number") {
  CHECK(NumberLists()[12].empty());
}

}  // namespace trismooth::number_lists_test
