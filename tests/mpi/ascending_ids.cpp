// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/ascending_ids.h"

#include <cstdint>
#include <random>
#include <vector>

#include "catch.h"

using trismooth::mpi::AscendingIds;

TEST_CASE("ids in stretches are the ids that were put in") {
  std::mt19937 generator(1);
  for (const int most_gap : {0, 1, 3, 1000000}) {
    // Of every length, none among them; with gaps that are 0 more or less often.
    std::vector<std::int64_t> expected;
    AscendingIds ids;
    std::int64_t id = most_gap == 3 ? (std::int64_t{1} << 61) : 0;
    for (int i = 0; i < 200; ++i) {
      CHECK(ids.size() == expected.size());
      CHECK(ids.listed() == expected);
      id += std::uniform_int_distribution(0, most_gap)(generator);
      ids.push_back(id);
      expected.push_back(id++);
    }
    bool are_same = true;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      are_same = are_same && ids[i] == expected[i];
    }
    CHECK(are_same);
    std::size_t next = 0;
    for (const std::int64_t found : ids) {
      are_same = are_same && found == expected[next++];
    }
    CHECK(are_same);
    CHECK(next == expected.size());
  }
}
