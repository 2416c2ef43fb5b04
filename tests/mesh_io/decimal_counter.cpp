// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/decimal_counter.h"

#include <cstdint>
#include <initializer_list>
#include <string>

#include "trismooth/mesh_io/text/plain_numbers.h"

#include "catch.h"

using trismooth::DecimalCounter;
using trismooth::PlainNumbers;

namespace {

/// Whether the text, with more behind it, begins with what the counter expects, and is read to there.
bool is_next(const DecimalCounter& expected, const std::string& number, const std::string& behind = "\n1 2 3 4 5\n") {
  const std::string text = " \n" + number + behind;
  PlainNumbers numbers(text, 0);
  const bool is = numbers.next_is(expected);
  if (is) {
    REQUIRE(numbers.token_offset() == 2);
    REQUIRE(numbers.offset() == 2 + number.size());
  } else {
    std::string next;
    std::int64_t value = 0;
    if (numbers.next(value)) {
      next = std::to_string(value);
    }
    // It still is there to be read.
    REQUIRE((next.empty() || numbers.token_offset() == 2));
  }
  return is;
}

}  // namespace

TEST_CASE("Numbers that count on are those of the text, from any number on") {
  for (const std::int64_t first : {0, 7, 95, 989, 9990, 99'990, 999'989, 9'999'995, 98'999'990}) {
    DecimalCounter counter(first);
    for (std::int64_t number = first; number < first + 1200; ++number) {
      CAPTURE(number);
      const std::string text = std::to_string(number);
      REQUIRE(is_next(counter, text));
      REQUIRE(counter.length() == text.size());
      counter.increment();
    }
  }
}

TEST_CASE("A number is the expected one as a whole and as it is written alone") {
  const DecimalCounter counter(42);
  for (const char* const other :
       {"41", "43", "4", "2", "142", "421", "042", "+42", "-42", "42.0", "4e1", "42a", "x", "42,"}) {
    CAPTURE(other);
    CHECK_FALSE(is_next(counter, other));
  }
  for (const char* const behind : {" 1 2 3 4 5", "\t1 2 3 4 5", "\r\n1 2 3 4"}) {
    CHECK(is_next(counter, "42", behind));
  }
}

TEST_CASE("What has no digits here is nowhere") {
  for (const std::int64_t number : {std::int64_t{-1}, std::int64_t{100'000'000}, INT64_MAX, INT64_MIN}) {
    DecimalCounter counter(number);
    CHECK(counter.length() == 0);
    CHECK_FALSE(is_next(counter, std::to_string(number)));
    counter.increment();
    CHECK(counter.length() == 0);
  }
  DecimalCounter last(99'999'999);
  CHECK(is_next(last, "99999999"));
  last.increment();
  CHECK(last.length() == 0);
  CHECK_FALSE(is_next(last, "00000000"));
  CHECK_FALSE(is_next(last, "100000000"));
}

TEST_CASE("Near the end of a text nothing is read behind it") {
  for (std::size_t length = 0; length <= 10; ++length) {
    const std::string text = std::string("12 3 4 5 67").substr(0, length);
    PlainNumbers numbers(text, 0);
    const bool is = numbers.next_is(DecimalCounter(12));
    CHECK((!is || length > 8));
  }
}
