// SPDX-License-Identifier: BSD-3-Clause
// Numbers in an ascending list are found at their places, however they lie.

#include "trismooth/pipeline/ranks/place_index.h"

#include <cstdint>
#include <limits>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::PlaceIndex;

namespace {

void check_places(const std::vector<std::int64_t>& numbers) {
  const PlaceIndex index(numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    CAPTURE(numbers.size(), i, numbers[i]);
    REQUIRE(index.place_of(numbers[i]) == static_cast<std::int32_t>(i));
  }
}

}  // namespace

TEST_CASE("numbers are found where they are, even, in stretches or far apart") {
  constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  check_places({});
  check_places({0});
  check_places({highest});
  check_places({0, highest});
  check_places({5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21});
  check_places({0, 1, 2, 3, 4, 5, 6, 7, highest - 2, highest - 1, highest});
  test_meshes::Random random(11);
  for (const std::int32_t widest : {1, 2, 9, 1000, 1 << 30}) {
    std::vector<std::int64_t> numbers;
    std::int64_t number = random.below(1 << 20);
    for (std::int32_t i = 0; i < 3000; ++i) {
      numbers.push_back(number);
      // Now and then a gap, else numbers that follow each other.
      number += 1 + (random.below(20) == 0 ? random.below(widest) : 0);
    }
    check_places(numbers);
  }
}
