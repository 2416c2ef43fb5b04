// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/bulk_memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <vector>

#ifdef __linux__
#include <unistd.h>
#endif

#include "catch.h"

using trismooth::BulkVector;

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21U;

BulkVector<std::uint8_t> filled(std::size_t size, std::uint8_t value) {
  BulkVector<std::uint8_t> bytes(size);
  std::fill(bytes.begin(), bytes.end(), value);
  return bytes;
}

}  // namespace

TEST_CASE("bulk memory of every size holds what is written to it, and large arrays begin at large pages") {
  std::vector<BulkVector<std::uint8_t>> arrays;
  std::vector<std::size_t> sizes;
  for (const std::size_t pages : {0, 1, 2, 5}) {
    for (const std::size_t size : {pages * large_page, pages * large_page + 1, (pages + 1) * large_page - 1}) {
      sizes.push_back(size);
      arrays.push_back(filled(size, static_cast<std::uint8_t>(sizes.size())));
    }
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const auto is_own = [&](std::uint8_t byte) { return byte == i + 1; };
    CHECK(std::all_of(arrays[i].begin(), arrays[i].end(), is_own));
    CHECK((sizes[i] < large_page || reinterpret_cast<std::uintptr_t>(arrays[i].data()) % large_page == 0));
  }
}

#ifdef __linux__
TEST_CASE("bulk memory goes back to the system, in whatever order it is released") {
  const auto resident = [] {
    std::ifstream file("/proc/self/statm");
    std::int64_t all = 0;
    std::int64_t pages = 0;
    file >> all >> pages;
    return pages * ::sysconf(_SC_PAGESIZE);
  };
  constexpr std::int64_t mebibyte = 1 << 20;
  const std::int64_t before = resident();
  std::vector<BulkVector<std::uint8_t>> arrays;
  for (std::size_t i = 0; i < 16; ++i) {
    arrays.push_back(filled(2 * large_page + 100 * i, 1));
  }
  // A sanitizer's notes of the arrays come and go with them, several times their size: shares of this hold for all.
  const std::int64_t whole = resident() - before;
  CHECK(whole > 60 * mebibyte);
  for (std::size_t i = 0; i < arrays.size(); i += 2) {
    BulkVector<std::uint8_t>().swap(arrays[i]);
  }
  CHECK(resident() - before < whole * 5 / 8);
  arrays.clear();
  CHECK(resident() - before < whole / 8);
}
#endif
