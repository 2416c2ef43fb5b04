#include "trismooth/smoothing/sweeps/vertex_groups.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

TEST_CASE("groups hold the marked vertices, each once and in order, those of a group with rings of one size") {
  constexpr int lanes = 4;
  test_meshes::Random random(5);
  for (int trial = 0; trial < 500; ++trial) {
    const auto count = static_cast<std::int32_t>(random.between(0, 80));
    const double share_of_marks = random.between(0, 1);
    const bool all = trial % 5 == 0;
    std::vector<std::int64_t> offsets{0};
    std::vector<std::uint8_t> marked;
    for (std::int32_t v = 0; v < count; ++v) {
      offsets.push_back(offsets.back() + 3 + static_cast<int>(random.between(0, 1.2)));
      marked.push_back(random.between(0, 1) < share_of_marks ? 1 : 0);
    }
    const std::vector<std::int32_t> neighbours(static_cast<std::size_t>(offsets.back()));
    const trismooth::RingView rings{offsets, neighbours, {}};
    const std::int32_t begin = count / 4;
    std::vector<std::int32_t> expected;
    for (std::int32_t v = begin; v < count; ++v) {
      if (all || marked[v] != 0) {
        expected.push_back(v);
      }
    }

    trismooth::VertexGroups<lanes> groups(rings, marked, all, begin, count);
    std::vector<std::int32_t> found;
    for (auto group = groups.next(); group.count > 0; group = groups.next()) {
      REQUIRE(group.count <= lanes);
      for (int i = 0; i < lanes; ++i) {
        const std::int32_t v = group.vertices[i];
        REQUIRE(rings[v].size() == rings[group.vertices[0]].size());
        if (i < group.count) {
          found.push_back(v);
          marked[v] = 0;
        } else {
          REQUIRE(v == group.vertices[0]);
        }
      }
    }
    REQUIRE(found == expected);
  }
}
