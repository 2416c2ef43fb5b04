// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/plain_rows.h"

#include <charconv>
#include <cstring>

#include "trismooth/mesh_io/text/number_text.h"

#include "catch.h"
#include "support/dice.h"

namespace trismooth::plain_rows_test {

using test_support::Dice;

/// What is read of rows of `columns` integers from `offset` on, and where that ends; nothing where it cannot be read.
struct Rows {
  bool read = false;
  std::vector<std::int64_t> numbers;
  std::size_t last_number = 0;
  std::size_t offset = 0;

  bool operator==(const Rows&) const = default;
};

Rows read_rows(const std::string& text, std::size_t offset, std::size_t rows, std::size_t columns,
               const FileWorkers& workers) {
  Rows result;
  result.numbers.resize(rows * columns);
  const auto end = PlainRows(text, workers)
                       .read(offset, rows, columns, [&](PlainNumbers& numbers, std::size_t first, std::size_t last) {
                         for (std::size_t i = first * columns; i < last * columns; ++i) {
                           if (!numbers.next(result.numbers[i])) {
                             return false;
                           }
                         }
                         return true;
                       });
  if (!end) {
    return {};
  }
  result.read = true;
  result.last_number = end->last_number;
  result.offset = end->offset;
  return result;
}

TEST_CASE("rows of numbers are the same in parts of any size") {
  Dice dice;
  Workers alone(1);
  Workers two(2);
  for (int round = 0; round < 40; ++round) {
    const std::string in_front = round % 3 == 0 ? "" : round % 3 == 1 ? "words and 1 2 " : "3\n";
    std::string text = in_front;
    std::vector<std::int64_t> expected;
    const std::size_t columns = 1 + dice.below(5);
    const std::size_t rows = 1 + dice.below(12);
    for (std::size_t i = 0; i < rows * columns; ++i) {
      std::string digits;
      for (std::size_t length = 1 + dice.below(round % 2 == 0 ? 3 : 17); length > 0; --length) {
        digits += static_cast<char>('0' + dice.below(10));
      }
      digits.insert(0, dice.below(4) == 0 ? "-" : "");
      expected.push_back(std::stoll(digits));
      text += digits;
      for (std::size_t blanks = 1 + dice.below(3); blanks > 0; --blanks) {
        text += " \n\t\r\v\f"[dice.below(6)];
      }
    }
    const std::size_t behind = text.find_last_of("0123456789") + 1;
    text += round % 2 == 0 ? "7 words" : "";
    for (const std::size_t part_bytes :
         {1UL, 2UL, 3UL, 4UL, 5UL, 7UL, 16UL, 63UL, 64UL, 65UL, 200UL, FileWorkers::whole}) {
      for (Workers* const workers : {&alone, &two}) {
        const Rows got = read_rows(text, in_front.size(), rows, columns, FileWorkers(*workers, part_bytes));
        REQUIRE(got.read);
        REQUIRE(got.numbers == expected);
        REQUIRE(got.offset == behind);
      }
    }
  }
}

TEST_CASE("what is not plain is left to others, wherever it stands") {
  Workers two(2);
  const std::vector<std::string> tokens(30, "12");
  for (const std::string odd : {"x", "#", "+1", "1#", "1.", "99999999999999999999", "0x1", "--1", "1,"}) {
    for (std::size_t at = 0; at < tokens.size(); ++at) {
      std::string text;
      for (std::size_t i = 0; i < tokens.size(); ++i) {
        text += (i == at ? odd : tokens[i]) + " ";
      }
      for (const std::size_t part_bytes : {1UL, 5UL, 32UL, FileWorkers::whole}) {
        CHECK_FALSE(read_rows(text, 0, 10, 3, FileWorkers(two, part_bytes)).read);
      }
    }
  }
  for (const std::size_t part_bytes : {1UL, 5UL, 32UL, FileWorkers::whole}) {
    CHECK_FALSE(read_rows("1 2 3 4 5 6 7 8", 0, 3, 3, FileWorkers(two, part_bytes)).read);
    CHECK_FALSE(read_rows("1 2 3 4 5 6 7 8", 15, 1, 1, FileWorkers(two, part_bytes)).read);
  }
  CHECK_FALSE(read_rows("OFF12 3 4 5 6 7 8", 3, 2, 3, FileWorkers(two, 4)).read);
}

TEST_CASE("numbers read as parse_number() and parse_integer_as() read them") {
  const auto agrees = [](const std::string& token, auto zero) {
    using T = decltype(zero);
    const std::string text = token + " 1 2 3 4 5 6 7 8 9";
    PlainNumbers numbers(text, 0);
    T value{};
    if (!numbers.next(value)) {
      return true;  // others judge it
    }
    if constexpr (std::is_floating_point_v<T>) {
      const auto expected = trismooth::parse_number<T>(token);
      return expected && std::memcmp(&*expected, &value, sizeof(T)) == 0 && numbers.offset() == token.size();
    } else {
      return trismooth::parse_integer_as<T>(token) == value && numbers.offset() == token.size();
    }
  };
  for (const std::string token : {"0",
                                  "-0",
                                  "007",
                                  "1",
                                  "12",
                                  "127",
                                  "128",
                                  "-128",
                                  "-129",
                                  "255",
                                  "256",
                                  "1234567",
                                  "12345678",
                                  "123456789",
                                  "2147483647",
                                  "2147483648",
                                  "-2147483648",
                                  "1e5",
                                  "1.5",
                                  "0.1",
                                  "-2.5e-3",
                                  "1e400",
                                  "1e-400",
                                  "nan",
                                  "inf",
                                  "-inf",
                                  "1/2",
                                  "9223372036854775807",
                                  "9223372036854775808",
                                  "18446744073709551615",
                                  ":",
                                  "/",
                                  "1:"}) {
    INFO(token);
    CHECK(agrees(token, std::int8_t{}));
    CHECK(agrees(token, std::uint8_t{}));
    CHECK(agrees(token, std::int32_t{}));
    CHECK(agrees(token, std::uint64_t{}));
    CHECK(agrees(token, std::int64_t{}));
    CHECK(agrees(token, float{}));
    CHECK(agrees(token, double{}));
  }
  std::int32_t value = 0;
  CHECK(PlainNumbers("1234567 89", 0).next(value));
  CHECK(value == 1234567);
}

}  // namespace trismooth::plain_rows_test
