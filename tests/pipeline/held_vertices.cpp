// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/held_vertices.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"

#include "catch.h"

namespace hold = trismooth::hold;

TEST_CASE("vertices count for each of their reasons, and once more where there are several") {
  const auto both = [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); };
  const std::vector<std::uint8_t> reasons{0,
                                          hold::boundary,
                                          both(hold::boundary, hold::interface),
                                          hold::interface,
                                          hold::named,
                                          both(hold::non_manifold, hold::bow_tie),  // the same cause
                                          hold::bow_tie,
                                          hold::isolated,
                                          both(hold::isolated, hold::other_cell),  // used by the other cell
                                          both(hold::other_cell, hold::named)};
  trismooth::Workers workers(1);
  const trismooth::HeldVertices held = trismooth::count_held(trismooth::count_reasons(reasons, workers), {.kept = 1});
  CHECK(held.boundary == 2);
  CHECK(held.interface == 2);
  CHECK(held.non_manifold == 1);
  CHECK(held.bow_tie == 1);
  CHECK(held.unused == 1);
  CHECK(held.other_cells == 2);
  CHECK(held.named == 1);  // of two, of which one is of a layer
  CHECK(held.layers == 1);
  CHECK(held.several == 2);
}

TEST_CASE("every vertex is counted once, by any number of threads") {
  constexpr std::size_t vertices = 300'001;
  std::vector<std::uint8_t> reasons(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    reasons[v] = static_cast<std::uint8_t>(v % 7);
  }
  for (const int threads : {1, 2, 3, 8}) {
    trismooth::Workers workers(threads);
    const trismooth::ReasonCounts counts = trismooth::count_reasons(reasons, workers);
    for (std::size_t bits = 0; bits < counts.size(); ++bits) {
      // Vertices bits, bits + 7, ...
      const std::size_t expected = bits < 7 ? (vertices - bits + 6) / 7 : 0;
      CHECK(counts[bits] == static_cast<std::int64_t>(expected));
    }
  }
}
