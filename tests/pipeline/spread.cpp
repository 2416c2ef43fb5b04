// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/spread.h"

#include <stdexcept>
#include <vector>

#include "catch.h"

using trismooth::ratio;
using trismooth::Spread;
using trismooth::three_digits;

TEST_CASE("a spread has the middle and both ends of its values, in whatever order they come") {
  const Spread odd(std::vector<double>{5, 1, 3});
  CHECK(odd.median == 3);
  CHECK(odd.least == 1);
  CHECK(odd.most == 5);
  CHECK(Spread(std::vector<double>{4, 1, 8, 2}).median == 3);
  const Spread one(std::vector<double>{7});
  CHECK((one.median == 7 && one.least == 7 && one.most == 7));
}

TEST_CASE("no values have no spread") {
  CHECK_THROWS_AS(Spread(std::vector<double>{}), std::invalid_argument);
}

TEST_CASE("a ratio's bounds hold every quotient of two measurements") {
  const std::vector<double> one{4, 5, 8};
  const std::vector<double> other{1, 2, 2.5};
  const Spread quotient = ratio(Spread(one), Spread(other));
  CHECK(quotient.median == 2.5);
  CHECK(quotient.least == 4 / 2.5);
  CHECK(quotient.most == 8);
  for (const double a : one) {
    for (const double b : other) {
      CHECK(a / b >= quotient.least);
      CHECK(a / b <= quotient.most);
    }
  }
}

TEST_CASE("numbers are written in about three digits") {
  CHECK(three_digits(0.04123) == "0.041");
  CHECK(three_digits(0.4123) == "0.412");
  CHECK(three_digits(4.123) == "4.12");
  CHECK(three_digits(41.23) == "41.2");
  CHECK(three_digits(412.3) == "412");
  CHECK(three_digits(41234.5) == "41234");
}

TEST_CASE("all numbers of a spread have the decimals of its median") {
  CHECK(Spread(3.4219, 3.414, 13.5).text() == "3.42 (3.41-13.50)");
  CHECK(Spread(120.4, 99.6, 130).text() == "120 (100-130)");
  CHECK(Spread(3.4219, 3.414, 13.5).range_text() == "3.41-13.50");
}
