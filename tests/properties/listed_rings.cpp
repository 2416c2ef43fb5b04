// SPDX-License-Identifier: BSD-3-Clause
#include "support/listed_rings.h"

#include <cstdint>

#include "catch.h"
#include "support/random_meshes.h"

TEST_CASE("rings as they are listed are those of matched sides, or there are none, for random meshes of every kind") {
  int found = 0;
  int others = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    CAPTURE(seed);
    const auto mesh = random_meshes::random_mesh(seed).mesh;
    const int threads = 1 + static_cast<int>(seed % 3);
    (listed_rings::require_those_of_matched_sides(mesh.vertex_count(), mesh.triangles, threads) ? found : others)++;
  }
  CHECK(found > 50);
  CHECK(others > 50);
}
