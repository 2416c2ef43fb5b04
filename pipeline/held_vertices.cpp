#include "trismooth/pipeline/held_vertices.h"

#include <array>

#include "trismooth/base/hold.h"

namespace trismooth {

HeldVertices count_held(std::span<const std::uint8_t> reasons) {
  HeldVertices held;
  for (const std::uint8_t bits : reasons) {
    const auto has = [bits](std::uint8_t bit) { return (bits & bit) != 0; };
    const bool non_manifold = has(hold::non_manifold);
    const bool other_cell = has(hold::other_cell);
    const std::array<std::pair<std::int64_t*, bool>, 7> counts{{{&held.boundary, has(hold::boundary)},
                                                                {&held.interface, has(hold::interface)},
                                                                {&held.non_manifold, non_manifold},
                                                                {&held.bow_tie, has(hold::bow_tie) && !non_manifold},
                                                                {&held.other_cells, other_cell},
                                                                {&held.unused, has(hold::isolated) && !other_cell},
                                                                {&held.named, has(hold::named)}}};
    int found = 0;
    for (const auto& [count, counts_here] : counts) {
      *count += counts_here ? 1 : 0;
      found += counts_here ? 1 : 0;
    }
    held.several += found > 1 ? 1 : 0;
  }
  return held;
}

}  // namespace trismooth
