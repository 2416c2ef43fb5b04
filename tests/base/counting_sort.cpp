// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/counting_sort.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/splitmix64.h"

#include "catch.h"

using trismooth::BulkVector;
using trismooth::counting_sort;
using trismooth::counting_sort_of_items;
using trismooth::KeyedNumber;
using trismooth::radix_sort;
using trismooth::splitmix64;
using trismooth::Workers;

namespace {

/// Keys below `keys`, by kinds: at random, all the same, descending.
std::vector<std::uint32_t> some_keys(std::int64_t size, std::uint64_t keys, int kind) {
  std::vector<std::uint32_t> made(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::uint64_t from = kind == 0 ? splitmix64(i) : kind == 1 ? 7 : made.size() - i;
    made[i] = static_cast<std::uint32_t>(from % keys);
  }
  return made;
}

std::vector<std::int32_t> sorted_numbers(const std::vector<std::uint32_t>& keys) {
  std::vector<std::int32_t> numbers(keys.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = static_cast<std::int32_t>(i);
  }
  std::ranges::sort(numbers, {}, [&](std::int32_t i) { return std::pair(keys[i], i); });
  return numbers;
}

}  // namespace

TEST_CASE("a counting sort is a stable sort, and says where each key begins") {
  constexpr std::int64_t count = 300;
  for (const std::int64_t size : {0, 1, 5, 1000, 100000}) {
    for (const int kind : {0, 1, 2}) {
      const auto keys = some_keys(size, count, kind);
      const auto expected = sorted_numbers(keys);
      auto sorted_keys = keys;
      std::ranges::sort(sorted_keys);
      for (const int threads : {1, 2, 3, 8}) {
        CAPTURE(threads, size, kind);
        Workers workers(threads);
        std::vector<std::int32_t> numbers(keys.size(), -1);
        const auto begins = counting_sort(
            size, count, [&](std::int64_t i) { return keys[i]; },
            [&](std::int64_t i, std::int64_t place) { numbers[place] = static_cast<std::int32_t>(i); }, workers);
        CHECK(numbers == expected);
        REQUIRE(begins.size() == count + 1);
        for (std::int64_t key = 0; key <= count; ++key) {
          REQUIRE(begins[key] == std::ranges::lower_bound(sorted_keys, key) - sorted_keys.begin());
        }
      }
    }
  }
}

TEST_CASE("items are sorted by their keys, and stay in order where these are equal, however many a number has") {
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers(threads);
    for (const std::int64_t size : {0, 1, 1000, 60000}) {
      CAPTURE(threads, size);
      // Number i has i % 4 items: (i, 0), (i, 1), ..; their keys are random.
      const auto key = [](std::int64_t i, int item) {
        return splitmix64(static_cast<std::uint64_t>(4 * i + item)) % 50;
      };
      std::vector<std::tuple<std::uint64_t, std::int64_t, int>> expected;
      for (std::int64_t i = 0; i < size; ++i) {
        for (int item = 0; item < i % 4; ++item) {
          expected.emplace_back(key(i, item), i, item);
        }
      }
      std::ranges::sort(expected);
      std::vector<std::tuple<std::uint64_t, std::int64_t, int>> sorted(expected.size());
      const auto begins = counting_sort_of_items(
          size, 50,
          [&](std::int64_t i, const auto& put_item) {
            for (int item = 0; item < i % 4; ++item) {
              put_item(key(i, item), i, item);
            }
          },
          [&](std::int64_t place, std::int64_t i, int item) {
            sorted[place] = {key(i, item), i, item};
          },
          workers);
      CHECK(sorted == expected);
      REQUIRE(begins.size() == 51);
      CHECK(begins.back() == std::ssize(expected));
    }
  }
}

TEST_CASE("a radix sort is a stable sort, for keys of any number of bits") {
  for (const std::int64_t size : {0, 1, 2048, 2049, 150000}) {
    for (const int bits : {1, 10, 11, 12, 22, 31}) {
      const auto keys = some_keys(size, std::uint64_t{1} << static_cast<unsigned>(bits), 0);
      const auto expected = sorted_numbers(keys);
      for (const int threads : {1, 2, 3, 8}) {
        CAPTURE(threads, size, bits);
        Workers workers(threads);
        BulkVector<KeyedNumber> items(keys.size());
        for (std::size_t i = 0; i < items.size(); ++i) {
          items[i] = {keys[i], static_cast<std::int32_t>(i)};
        }
        radix_sort(items, bits, workers);
        CHECK(std::ranges::equal(items, expected, {}, &KeyedNumber::number));
        CHECK(std::ranges::all_of(items, [&](const KeyedNumber& item) { return item.key == keys[item.number]; }));
      }
    }
  }
}
