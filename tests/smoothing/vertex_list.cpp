// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/vertex_list.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::vertex_list_test {

TEST_CASE("lists hold the marked vertices of a block, each once and in order, and take their marks away") {
  test_meshes::Random random(5);
  for (int trial = 0; trial < 500; ++trial) {
    const std::int32_t count = random.below(trial % 10 == 0 ? 5000 : 80);
    const double share_of_marks = random.between(0, 1);
    const bool all = trial % 5 == 0;
    std::vector<std::uint8_t> marked;
    for (std::int32_t v = 0; v < count; ++v) {
      marked.push_back(random.between(0, 1) < share_of_marks ? 1 : 0);
    }
    const std::int32_t begin = count / 4;
    const std::int32_t end = count - count / 5;
    std::vector<std::int32_t> expected;
    std::vector<std::uint8_t> left = marked;
    for (std::int32_t v = begin; v < end; ++v) {
      if (all || marked[v] != 0) {
        expected.push_back(v);
      }
      left[v] = all ? left[v] : 0;
    }

    trismooth::VertexList list(marked, all, begin, end);
    std::vector<std::int32_t> found;
    for (auto vertices = list.next(); !vertices.empty(); vertices = list.next()) {
      found.insert(found.end(), vertices.begin(), vertices.end());
    }
    REQUIRE(found == expected);
    REQUIRE(marked == left);
  }
}

TEST_CASE("runs of one ring size follow each other, and none could be longer") {
  test_meshes::Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::int64_t> offsets{0};
    for (int v = 0; v < 100; ++v) {
      offsets.push_back(offsets.back() + 3 + random.below(2));
    }
    const std::vector<std::int32_t> neighbours(static_cast<std::size_t>(offsets.back()));
    const trismooth::RingView rings{offsets, neighbours, {}};
    std::vector<std::int32_t> vertices;
    for (std::int32_t v = 0; v < 100; ++v) {
      if (random.below(3) > 0) {
        vertices.push_back(v);
      }
    }
    std::vector<std::int32_t> found;
    int size_before = 0;
    trismooth::for_runs_of_one_size(rings, vertices, [&](std::span<const std::int32_t> run, int ring_size) {
      REQUIRE(!run.empty());
      REQUIRE(ring_size != size_before);
      size_before = ring_size;
      REQUIRE(std::ranges::all_of(run, [&](std::int32_t v) { return std::ssize(rings[v]) == ring_size; }));
      found.insert(found.end(), run.begin(), run.end());
    });
    REQUIRE(found == vertices);
  }
}

}  // namespace trismooth::vertex_list_test
