// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/digits.h"

#include <limits>

#include "catch.h"

using trismooth::fixed_digits;
using trismooth::general_digits;
using trismooth::plain_text;
using trismooth::scientific_digits;
using trismooth::shortest_digits;
using trismooth::shortest_text;

TEST_CASE("numbers have the digits that are asked for") {
  CHECK(fixed_digits(12.5, 2) == "12.50");
  CHECK(fixed_digits(-0.125, 2) == "-0.12");  // a half goes to the even digit
  CHECK(fixed_digits(1e300, 0).size() == 301);
  CHECK(scientific_digits(12.5, 2) == "1.25e+01");
  CHECK(scientific_digits(3e-7, 0) == "3e-07");
  CHECK(general_digits(12.5, 8) == "12.5");
  CHECK(general_digits(1.25e9, 8) == "1.25e+09");
  CHECK(shortest_digits(0.1) == "0.1");
  CHECK(shortest_digits(1e15) == "1000000000000000");
  CHECK(shortest_text(0.1) == "0.1");
  CHECK(shortest_text(1e300) == "1e+300");
}

TEST_CASE("plain text has an exponent where there would be many zeros alone") {
  CHECK(plain_text(0.1) == "0.1");
  CHECK(plain_text(0.1F) == "0.1");
  CHECK(plain_text(-12.25) == "-12.25");
  CHECK(plain_text(0.0) == "0");
  CHECK(plain_text(-0.0) == "-0");
  CHECK(plain_text(7.0) == "7");
  CHECK(plain_text(1e5) == "100000");
  CHECK(plain_text(1.23456789012e11F) == "123456790000");
  CHECK(plain_text(1e-4) == "0.0001");
  CHECK(plain_text(2.5e-5) == "2.5e-05");
  CHECK(plain_text(9007199254740993e0) == "9007199254740992");
  CHECK(plain_text(-1e16) == "-1e+16");
  CHECK(plain_text(std::numeric_limits<float>::infinity()) == "inf");
}

TEST_CASE("what is no finite number has a name instead of digits") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(shortest_digits(infinity) == "inf");
  CHECK(fixed_digits(-infinity, 3) == "-inf");
  CHECK(general_digits(std::numeric_limits<double>::quiet_NaN(), 3) == "nan");
}
