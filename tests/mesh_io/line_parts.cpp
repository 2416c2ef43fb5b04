// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/line_parts.h"

#include <algorithm>
#include <string>

#include "trismooth/mesh_io/text/plain_numbers.h"
#include "trismooth/mesh_io/text/token_count.h"

#include "catch.h"
#include "support/dice.h"

using test_support::Dice;
using trismooth::FileWorkers;
using trismooth::LineParts;
using trismooth::Workers;

namespace {

/// Random bytes, many of them alike or near to line ends and white space in some bits.
std::string random_text(Dice& dice, std::size_t longest, std::string_view characters) {
  std::string text;
  for (std::size_t size = dice.below(longest); size > 0; --size) {
    text += characters[dice.below(characters.size())];
  }
  return text;
}

constexpr std::string_view near_line_ends{"\n\r\t\v\f\x0e\x08 !xyz019.-\x8a\x8d\xff\0\x01\x20\x8b\x0a", 24};

}  // namespace

TEST_CASE("the first line end is found, wherever it stands") {
  Dice dice;
  for (int round = 0; round < 2000; ++round) {
    const std::string_view some = near_line_ends.substr(round % 2 == 0 ? 0 : 2, 20);
    const std::string text = random_text(dice, 40, some) + std::string(round % 3, '\n');
    for (std::size_t begin = 0; begin <= text.size(); ++begin) {
      REQUIRE(trismooth::find_line_end(text, begin) == std::min(text.find_first_of("\r\n", begin), text.size()));
    }
  }
}

TEST_CASE("tokens of any stretch of a text are counted where they begin") {
  Dice dice;
  for (int round = 0; round < 300; ++round) {
    const std::string text = random_text(dice, 60, near_line_ends);
    for (std::size_t begin = 0; begin <= text.size(); ++begin) {
      std::size_t expected = 0;
      for (std::size_t end = begin; end <= text.size(); ++end) {
        REQUIRE(trismooth::count_tokens(text, begin, end) == expected);
        const bool begins = end < text.size() && !trismooth::is_white_space(text[end]) &&
                            (end == 0 || trismooth::is_white_space(text[end - 1]));
        expected += begins ? 1 : 0;
      }
    }
  }
}

TEST_CASE("tokens of long texts are counted, however close they stand") {
  Dice dice;
  for (const std::string_view some : {near_line_ends, std::string_view(" x"), std::string_view("  \n9")}) {
    const std::string text = random_text(dice, 40'000, some) + std::string(20'000, 'y');
    std::string closest;
    while (closest.size() < 50'000) {
      closest += "1 ";
    }
    for (const std::string& long_text : {text, closest}) {
      for (const std::size_t begin : {std::size_t{0}, std::size_t{1}, std::size_t{37}}) {
        std::size_t expected = 0;
        for (std::size_t i = std::min(begin, long_text.size()); i < long_text.size(); ++i) {
          const bool begins =
              !trismooth::is_white_space(long_text[i]) && (i == 0 || trismooth::is_white_space(long_text[i - 1]));
          expected += begins ? 1 : 0;
        }
        REQUIRE(trismooth::count_tokens(long_text, begin, long_text.size()) == expected);
      }
    }
  }
}

TEST_CASE("a text is cut behind line ends, in parts of the size that is asked for") {
  Dice dice;
  Workers two(2);
  for (int round = 0; round < 1000; ++round) {
    const std::string text = random_text(dice, 200, "ab c\n\r");
    const std::size_t begin = dice.below(text.size() + 1);
    const std::size_t part_bytes = round % 10 == 0 ? FileWorkers::whole : 1 + dice.below(30);
    const LineParts parts(text, begin, FileWorkers(two, part_bytes));
    REQUIRE((parts.size() == 0) == (begin == text.size()));
    for (std::size_t part = 0; part < parts.size(); ++part) {
      REQUIRE(parts.begin(part) == (part == 0 ? begin : parts.end(part - 1)));
      REQUIRE(parts.begin(part) < parts.end(part));
      const std::string_view bytes = std::string_view(text).substr(0, parts.end(part)).substr(parts.begin(part));
      if (part + 1 == parts.size()) {
        REQUIRE(parts.end(part) == text.size());
      } else {
        REQUIRE(bytes.size() >= part_bytes);
        REQUIRE(bytes.find_first_of("\r\n", part_bytes - 1) == bytes.size() - 1);
      }
    }
    std::vector<int> calls(parts.size());
    REQUIRE(parts.all_of([&calls](std::size_t part) { return ++calls[part] == 1; }));
    REQUIRE(std::ranges::count(calls, 1) == static_cast<std::ptrdiff_t>(calls.size()));
    if (parts.size() > 0) {
      const std::size_t failing = dice.below(parts.size());
      REQUIRE_FALSE(parts.all_of([failing](std::size_t part) { return part != failing; }));
    }
  }
}
