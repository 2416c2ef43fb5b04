// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/number_places.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::number_places_test {

TEST_CASE("numbers have their places in the order of those that differ, and others have none") {
  test_meshes::Random random(1);
  for (const std::int32_t range : {1, 3, 50, 2'000'000'000}) {
    for (const int count : {0, 1, 7, 1000}) {
      std::vector<std::int32_t> numbers;
      for (int i = 0; i < count; ++i) {
        numbers.push_back(random.below(range));
      }
      const std::set<std::int32_t> differing(numbers.begin(), numbers.end());
      const NumberPlaces places(numbers);
      REQUIRE(std::ranges::equal(places.sorted(), differing));
      for (std::int32_t place = 0; place < std::ssize(places.sorted()); ++place) {
        REQUIRE(places.of(places.sorted()[static_cast<std::size_t>(place)]) == place);
      }
      for (int i = 0; i < 100; ++i) {
        const std::int32_t other = random.below(2'000'000'000);
        REQUIRE((places.of(other) == NumberPlaces::none) == !differing.contains(other));
      }
    }
  }
}

}  // namespace trismooth::number_places_test
