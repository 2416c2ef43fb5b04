// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/option_parsing.h"

#include <stdexcept>
#include <string>

#include "trismooth/smoothing/options.h"

#include "catch.h"

namespace trismooth::option_parsing_test {

TEST_CASE("a count has K and M for thousands and millions") {
  CHECK(parse_count("4", 4, 1'000'000'000) == 4);
  CHECK(parse_count("1K", 4, 1'000'000'000) == 1'000);
  CHECK(parse_count("50k", 4, 1'000'000'000) == 50'000);
  CHECK(parse_count("10M", 4, 1'000'000'000) == 10'000'000);
  CHECK(parse_count("2m", 4, 1'000'000'000) == 2'000'000);
  CHECK(parse_count("1000M", 4, 1'000'000'000) == 1'000'000'000);
  CHECK(parse_count("0K", 0, 10) == 0);
}

TEST_CASE("what is no count, or out of range, is answered with the range and the units") {
  for (const std::string bad : {"", "K", "3", "0K", "-1K", "1e6", "1.5K", "1KK", "K1", " 1K", "1 K", "1G", "2M",
                                "1001K", "99999999999999999999", "9223372036854775807M"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(parse_count(bad, 4, 1'000'000),
                      "expected a whole number from 4 to 1000000, with K or M for "
                      "thousands or millions, got '" +
                          bad + "'");
  }
}

TEST_CASE("a choice that is nearly one of the valid ones is answered with that one") {
  using trismooth::Method;
  CHECK(trismooth::parse_choice<Method>("laplacian") == Method::laplacian);
  CHECK_THROWS_WITH(
      trismooth::parse_choice<Method>("lapalcian"),
      "unknown method 'lapalcian'; valid are " + trismooth::valid_texts<Method>() + " (did you mean 'laplacian'?)");
  CHECK_THROWS_WITH(trismooth::parse_choice<Method>("x"),
                    "unknown method 'x'; valid are " + trismooth::valid_texts<Method>());
}

}  // namespace trismooth::option_parsing_test
