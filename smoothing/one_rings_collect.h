#pragma once

#include <algorithm>
#include <vector>

#include "trismooth/smoothing/one_rings.h"

namespace trismooth {

template <class Visit>
OneRings collect_one_rings(std::int32_t vertex_count, std::span<const std::uint8_t> fixed, Workers& workers,
                           const Visit& visit) {
  constexpr std::int64_t grain = 4096;
  OneRings rings;
  rings.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  workers.for_blocks(vertex_count, grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      if (fixed[v] == 0) {
        std::int64_t count = 0;
        visit(v, [&](std::int32_t) { ++count; });
        rings.offsets[v + 1] = count;
      }
    }
  });
  for (std::int32_t v = 0; v < vertex_count; ++v) {
    rings.offsets[v + 1] += rings.offsets[v];
  }
  rings.neighbours.resize(static_cast<std::size_t>(rings.offsets.back()));
  workers.for_blocks(vertex_count, grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      if (rings.is_free(v)) {
        std::int32_t* const ring = rings.neighbours.data() + rings.offsets[v];
        std::int32_t* last = ring;
        visit(v, [&](std::int32_t neighbour) { *last++ = neighbour; });
        std::rotate(ring, std::min_element(ring, last), last);
      }
    }
  });
  return rings;
}

}  // namespace trismooth
