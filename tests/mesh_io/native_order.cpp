// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/native_order.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "catch.h"

using trismooth::FileWorkers;
using trismooth::Workers;

TEST_CASE("words of the other byte order are turned round, each by itself, and what is behind the last one stays") {
  constexpr bool other_is_big = std::endian::native == std::endian::little;
  Workers workers(GENERATE(1, 3));
  for (const std::size_t word_size : {1, 2, 4, 8}) {
    for (const std::size_t size : {0, 1, 7, 8, 64, 1001}) {
      std::vector<std::uint8_t> bytes(size);
      std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
      std::vector<std::uint8_t> expected = bytes;
      for (std::size_t word = 0; (word + 1) * word_size <= size; ++word) {
        for (std::size_t i = 0; i < word_size; ++i) {
          expected[word * word_size + i] = bytes[(word + 1) * word_size - 1 - i];
        }
      }
      for (const std::size_t part_bytes : {FileWorkers::serial, std::size_t{1}, std::size_t{24}, FileWorkers::whole}) {
        CAPTURE(word_size, size, part_bytes);
        std::vector<std::uint8_t> turned = bytes;
        auto* const begin = reinterpret_cast<std::byte*>(turned.data());
        trismooth::to_native_order(begin, size, word_size, !other_is_big, FileWorkers(workers, part_bytes));
        CHECK(turned == bytes);
        trismooth::to_native_order(begin, size, word_size, other_is_big, FileWorkers(workers, part_bytes));
        CHECK(turned == expected);
      }
    }
  }
}
