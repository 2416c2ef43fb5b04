// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/splitmix64.h"

#include <cstdint>
#include <limits>

#include "catch.h"

namespace trismooth::splitmix64_test {

TEST_CASE("splitmix64 gives the published sequence of the generator") {
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15U;
  CHECK(splitmix64(0) == 0xe220a8397b1dcdafU);
  CHECK(splitmix64(step) == 0x6e789e6aa1b965f4U);
  CHECK(splitmix64(2 * step) == 0x06c45d188009454fU);
  CHECK(splitmix64(3 * step) == 0xf88bb8a8724c81ecU);
  CHECK(splitmix64(1234567) == 6457827717110365317U);
  CHECK(splitmix64(1234567 + step) == 3203168211198807973U);
  CHECK(splitmix64(1234567 + 2 * step) == 9817491932198370423U);
  static_assert(splitmix64(0) == 0xe220a8397b1dcdafU);
}

TEST_CASE("the colouring order is strict and total") {
  for (std::int32_t a = 0; a < 300; ++a) {
    CHECK_FALSE(coloured_before(a, a));
    for (std::int32_t b = a + 1; b < 300; ++b) {
      REQUIRE(coloured_before(a, b) != coloured_before(b, a));
      REQUIRE(coloured_before(a, b) ==
              (splitmix64(static_cast<std::uint64_t>(a)) < splitmix64(static_cast<std::uint64_t>(b))));
    }
  }
  CHECK(coloured_before(0, std::numeric_limits<std::int32_t>::max()) !=
        coloured_before(std::numeric_limits<std::int32_t>::max(), 0));
}

}  // namespace trismooth::splitmix64_test
