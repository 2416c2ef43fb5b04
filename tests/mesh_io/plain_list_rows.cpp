// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/plain_list_rows.h"

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "catch.h"
#include "support/dice.h"

using test_support::Dice;
using trismooth::FileWorkers;
using trismooth::PlainListRows;
using trismooth::PlainNumbers;
using trismooth::Workers;

namespace {

/// Lists with a number in front of each, and its index behind it.
struct Lists {
  std::vector<std::vector<std::int64_t>> items;
  std::vector<std::int64_t> in_front;

  bool operator==(const Lists&) const = default;
};

Lists random_lists(Dice& dice) {
  Lists lists;
  lists.items.resize(1 + dice.below(20));
  for (auto& list : lists.items) {
    lists.in_front.push_back(static_cast<std::int64_t>(dice.below(100)));
    for (std::size_t size = dice.below(6); size > 0; --size) {
      list.push_back(static_cast<std::int64_t>(dice.below(10000)));
    }
  }
  return lists;
}

std::string text_of(const Lists& lists, Dice& dice) {
  std::string text;
  for (std::size_t row = 0; row < lists.items.size(); ++row) {
    text += std::to_string(lists.in_front[row]) + " " + std::to_string(lists.items[row].size());
    for (const std::int64_t item : lists.items[row]) {
      text += (dice.below(3) == 0 ? "  " : "\t") + std::to_string(item);
    }
    text += std::string(dice.below(3), ' ');
    for (std::size_t ends = 1 + dice.below(2); ends > 0; --ends) {
      text += dice.below(2) == 0 ? "\n" : "\r\n";
    }
  }
  return text;
}

/// Nothing where the rows cannot be read.
std::optional<Lists> read(const std::string& text, std::size_t offset, std::size_t rows, const FileWorkers& workers,
                          trismooth::PlainRows::End& end) {
  const PlainListRows list_rows(text, offset, rows, 1, workers);
  if (!list_rows.items()) {
    return std::nullopt;
  }
  Lists lists;
  lists.items.resize(rows);
  lists.in_front.resize(rows);
  std::vector<std::size_t> begins(rows);
  const auto found = list_rows.read([&](PlainNumbers& numbers, const PlainListRows::Part& part) {
    std::size_t item = part.first_item;
    for (std::size_t row = part.first; row < part.last; ++row) {
      begins[row] = item;
      std::size_t size = 0;
      if (!numbers.next(lists.in_front[row]) || !numbers.next(size) || size > part.last_item - item) {
        return false;
      }
      lists.items[row].resize(size);
      for (std::int64_t& value : lists.items[row]) {
        if (!numbers.next(value)) {
          return false;
        }
      }
      item += size;
      if (!numbers.at_end_of_line()) {
        return false;
      }
    }
    return true;
  });
  if (!found) {
    return std::nullopt;
  }
  std::size_t before = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    REQUIRE(begins[row] == before);
    before += lists.items[row].size();
  }
  REQUIRE(before == *list_rows.items());
  end = *found;
  return lists;
}

/// The same line by line; nothing where a line is not as long as it says.
std::optional<Lists> read_lines(const std::string& text, std::size_t rows) {
  Lists lists;
  std::istringstream lines(text);
  for (std::string line; lists.items.size() < rows && std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::int64_t> numbers;
    for (std::string word; words >> word;) {
      if (word.find_first_not_of("0123456789") != std::string::npos) {
        return std::nullopt;
      }
      numbers.push_back(std::stoll(word));
    }
    if (numbers.empty()) {
      continue;
    }
    if (numbers.size() < 2 || numbers[1] + 2 != static_cast<std::int64_t>(numbers.size())) {
      return std::nullopt;
    }
    lists.in_front.push_back(numbers[0]);
    lists.items.emplace_back(numbers.begin() + 2, numbers.end());
  }
  return lists.items.size() == rows ? std::optional(lists) : std::nullopt;
}

}  // namespace

TEST_CASE("lists of any lengths are the same in parts of any size") {
  Dice dice;
  Workers alone(1);
  Workers two(2);
  for (int round = 0; round < 300; ++round) {
    const Lists lists = random_lists(dice);
    const std::string in_front = round % 2 == 0 ? "" : "3 words in front\n";
    const std::string rows = text_of(lists, dice);
    const std::string behind = round % 3 == 0 ? "" : round % 3 == 1 ? "1 2 7 8\n" : "some # words\n9\n\n9\n";
    const std::string text = in_front + rows + behind;
    for (const std::size_t part_bytes : {std::size_t{1}, 1 + dice.below(20), 1 + dice.below(200), FileWorkers::whole}) {
      for (Workers* const workers : {&alone, &two}) {
        trismooth::PlainRows::End end{};
        const auto got = read(text, in_front.size(), lists.items.size(), FileWorkers(*workers, part_bytes), end);
        REQUIRE(got == lists);
        const std::size_t last = rows.find_last_of("0123456789");
        REQUIRE(end.last_number == in_front.size() + rows.find_last_of(" \t", last) + 1);
        REQUIRE(end.offset >= in_front.size() + last + 1);
        REQUIRE(text.find_first_not_of(' ', end.offset) == rows.find_first_of("\r\n", last) + in_front.size());
      }
    }
  }
}

TEST_CASE("rows of lists that are not a line each, or not as long as they say, are left to others") {
  Dice dice;
  Workers two(2);
  int broken = 0;
  for (int round = 0; round < 2000; ++round) {
    const Lists lists = random_lists(dice);
    std::string text = text_of(lists, dice);
    const std::size_t rows = lists.items.size();
    std::size_t at = dice.below(text.size());
    while (text[at] < '0' || text[at] > '9') {
      at = (at + 1) % text.size();
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
    switch (round % 4) {
      case 0:  // a number more
        text.insert(end, " 3");
        break;
      case 1:  // a line end more, between two numbers
        text.insert(end, "\n3");
        break;
      case 2:  // no number
        text[at] = 'x';
        break;
      default:  // a row less
        text.erase(text.find_last_of('\n', text.find_last_of("0123456789")) + 1);
        break;
    }
    const std::optional<Lists> expected = read_lines(text, rows);
    broken += expected ? 0 : 1;
    for (const std::size_t part_bytes : {std::size_t{1}, 1 + dice.below(20), 1 + dice.below(200), FileWorkers::whole}) {
      trismooth::PlainRows::End ignored{};
      INFO(text);
      REQUIRE(read(text, 0, rows, FileWorkers(two, part_bytes), ignored) == expected);
    }
  }
  CHECK(broken > 1500);
}
