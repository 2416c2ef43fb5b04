// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/held_vertices.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/joined_blocks.h"

namespace trismooth {

ReasonCounts count_reasons(std::span<const std::uint8_t> reasons, Workers& workers) {
  constexpr std::int64_t grain = 65536;
  return joined_blocks(
      std::ssize(reasons), grain, workers, ReasonCounts{},
      [&](std::int64_t begin, std::int64_t end, ReasonCounts& counts) {
        for (std::int64_t v = begin; v < end; ++v) {
          ++counts[reasons[static_cast<std::size_t>(v)]];
        }
      },
      [](ReasonCounts& all, const ReasonCounts& counts) {
        std::ranges::transform(all, counts, all.begin(), std::plus<>());
      });
}

HeldVertices count_held(const ReasonCounts& counts, const LayersResult& layers) {
  HeldVertices held;
  for (std::size_t bits = 0; bits < counts.size(); ++bits) {
    const auto has = [bits](std::uint8_t bit) { return (bits & bit) != 0; };
    const bool non_manifold = has(hold::non_manifold);
    const bool other_cell = has(hold::other_cell) || has(hold::line);
    const std::array<std::pair<std::int64_t*, bool>, 7> figures{{{&held.boundary, has(hold::boundary)},
                                                                 {&held.interface, has(hold::interface)},
                                                                 {&held.non_manifold, non_manifold},
                                                                 {&held.bow_tie, has(hold::bow_tie) && !non_manifold},
                                                                 {&held.other_cells, other_cell},
                                                                 {&held.unused, has(hold::isolated) && !other_cell},
                                                                 {&held.named, has(hold::named)}}};
    int found = 0;
    for (const auto& [figure, counts_here] : figures) {
      *figure += counts_here ? counts[bits] : 0;
      found += counts_here ? 1 : 0;
    }
    held.several += found > 1 ? counts[bits] : 0;
  }
  held.named -= layers.kept + layers.kept_on_lines;
  held.layers = layers.kept + layers.kept_on_lines;
  return held;
}

}  // namespace trismooth
