// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/value_numbers.h"

#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::value_numbers_test {

using Numbers = std::vector<std::int32_t>;

Numbers all_rows(std::size_t count) {
  Numbers rows(count);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

TEST_CASE("values are numbered in ascending order, each with its first item, at the rows that are asked for") {
  const auto array = make_data_array("a", 1, std::vector<std::int16_t>{5, -2, 5, 9, -2, 7});
  const ValueNumbers all = number_values(array, all_rows(6));
  CHECK(all.of_item == Numbers{1, 0, 1, 3, 0, 2});
  CHECK(all.example == Numbers{1, 0, 5, 3});
  CHECK(all.count() == 4);
  const ValueNumbers some = number_values(array, Numbers{3, 3, 0});
  CHECK(some.of_item == Numbers{1, 1, 0});
  CHECK(some.example == Numbers{2, 0});
  CHECK(number_values(array, Numbers{}).count() == 0);
}

TEST_CASE("equal values have equal numbers and smaller ones smaller numbers, in whatever order they come") {
  test_meshes::Random random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::int64_t> values(static_cast<std::size_t>(1 + random.below(60)));
    for (auto& value : values) {
      value = random.below(1 + random.below(20)) - 4;
    }
    const ValueNumbers numbers = number_values(make_data_array("a", 1, values), all_rows(values.size()));
    for (std::size_t a = 0; a < values.size(); ++a) {
      for (std::size_t b = 0; b < values.size(); ++b) {
        REQUIRE((values[a] < values[b]) == (numbers.of_item[a] < numbers.of_item[b]));
      }
      const auto example = static_cast<std::size_t>(numbers.example[static_cast<std::size_t>(numbers.of_item[a])]);
      REQUIRE(values[example] == values[a]);
      REQUIRE(example <= a);
    }
  }
}

TEST_CASE("not-a-numbers are one value, the last, and the two zeros are one") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto array = make_data_array("a", 1, std::vector<double>{nan, 0.0, infinity, -nan, -0.0});
  CHECK(number_values(array, all_rows(5)).of_item == Numbers{2, 0, 1, 2, 0});
}

TEST_CASE("pairs are equal where both values are") {
  const auto first = number_values(make_data_array("a", 1, Numbers{1, 1, 2, 2, 1}), all_rows(5));
  const auto second = number_values(make_data_array("b", 1, Numbers{7, 8, 7, 8, 7}), all_rows(5));
  CHECK(number_pairs(first, second).of_item == Numbers{0, 1, 2, 3, 0});
}

TEST_CASE("whole numbers are told from fractions and from what is not finite") {
  const auto whole = [](const std::vector<float>& values) {
    const auto array = make_data_array("a", 1, values);
    const Numbers rows = all_rows(values.size());
    return trismooth::are_whole(array, rows, number_values(array, rows));
  };
  CHECK(whole({1, -3, 1e30F, 0}));
  CHECK_FALSE(whole({1, 0.5F}));
  CHECK_FALSE(whole({1, std::numeric_limits<float>::quiet_NaN()}));
  CHECK_FALSE(whole({1, std::numeric_limits<float>::infinity()}));
}

TEST_CASE("a value's text has every digit") {
  CHECK(value_text(make_data_array("a", 1, std::vector<std::int8_t>{-5}), 0) == "-5");
  CHECK(value_text(make_data_array("a", 1, std::vector<std::uint8_t>{200}), 0) == "200");
  CHECK(value_text(make_data_array("a", 1, std::vector<std::uint64_t>{18446744073709551615U}), 0) ==
        "18446744073709551615");
  CHECK(value_text(make_data_array("a", 1, std::vector<float>{0.1F, 3}), 0) == "0.1");
  CHECK(value_text(make_data_array("a", 1, std::vector<float>{0.1F, 3}), 1) == "3");
  CHECK(value_text(make_data_array("a", 1, std::vector<double>{std::numeric_limits<double>::quiet_NaN()}), 0) == "nan");
}

TEST_CASE("copies of an item with other values make a value of the set of them, whatever their order") {
  const auto array = make_data_array("a", 1, std::vector<std::int16_t>{1, 1, 1, 2, 2, 3, 2, 3, 1, 1});
  // The first five are the items: 1; 1, 3 and 2; 1 and 1; 2, 3 and 1; 2.
  const ValueNumbers joined = trismooth::join_copies(number_values(array, all_rows(10)), Numbers{1, 1, 3, 3, 2});
  CHECK(joined.of_item == Numbers{0, 2, 0, 2, 1});
  CHECK(joined.example == Numbers{0, 4, 1});
}

}  // namespace trismooth::value_numbers_test
