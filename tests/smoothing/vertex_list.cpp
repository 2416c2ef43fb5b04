// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/vertex_list.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
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

TEST_CASE("listed vertices of a run of one ring size and kind are visited together") {
  test_meshes::Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::int64_t> offsets{0};
    for (int v = 0; v < 100; ++v) {
      offsets.push_back(offsets.back() + 3 + random.below(2));
    }
    const std::vector<std::int32_t> neighbours(static_cast<std::size_t>(offsets.back()));
    // Of each vertex one of three kinds, or of all of them triangles.
    std::vector<std::int32_t> opposites(random.below(2) == 0 ? 0 : neighbours.size());
    std::vector<trismooth::RingKind> kinds(100, trismooth::RingKind::triangles);
    for (std::size_t v = 0; v < 100 && !opposites.empty(); ++v) {
      kinds[v] = static_cast<trismooth::RingKind>(random.below(3));
      for (auto i = static_cast<std::size_t>(offsets[v]); i < static_cast<std::size_t>(offsets[v + 1]); ++i) {
        const bool is_first = std::cmp_equal(i, offsets[v]);
        const bool is_triangle =
            kinds[v] == trismooth::RingKind::triangles || (kinds[v] == trismooth::RingKind::both && is_first);
        opposites[i] = is_triangle ? trismooth::no_corner : 5;
      }
    }
    const trismooth::RingView rings{offsets, neighbours, {}, opposites};
    std::vector<trismooth::RingRun> runs;
    for (std::int32_t v = 0; v < 100; ++v) {
      const auto size = static_cast<std::int32_t>(rings[v].size());
      if (runs.empty() || runs.back().ring_size != size || runs.back().kind != kinds[static_cast<std::size_t>(v)]) {
        runs.push_back({v, size, kinds[static_cast<std::size_t>(v)]});
      }
      runs.back().end = v + 1;
    }
    std::vector<std::int32_t> vertices;
    const int density = random.below(11);
    for (std::int32_t v = 0; v < 100; ++v) {
      if (random.below(10) < density) {
        vertices.push_back(v);
      }
    }
    std::vector<std::int32_t> found;
    std::int32_t end_before = 0;
    trismooth::for_runs_of_one_size(
        runs, vertices, [&](std::span<const std::int32_t> run, int ring_size, trismooth::RingKind kind) {
          REQUIRE(!run.empty());
          const auto all = std::ranges::upper_bound(runs, run.front(), {}, &trismooth::RingRun::end);
          REQUIRE(run.front() >= end_before);
          REQUIRE(run.back() < all->end);
          end_before = all->end;
          REQUIRE(std::ranges::all_of(run, [&](std::int32_t v) {
            return std::ssize(rings[v]) == ring_size && kinds[static_cast<std::size_t>(v)] == kind;
          }));
          found.insert(found.end(), run.begin(), run.end());
        });
    REQUIRE(found == vertices);
  }
}

}  // namespace trismooth::vertex_list_test
