// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/patch.h"

#include <cstddef>

#include "trismooth/quality/element.h"

namespace trismooth {

PatchCutter::PatchCutter(const RingView& rings, std::int32_t vertex_count)
    : rings_(rings), number_(static_cast<std::size_t>(vertex_count), -1) {}

Patch PatchCutter::cut(std::span<const std::int32_t> free) {
  Patch patch;
  patch.vertices.assign(free.begin(), free.end());
  patch.free_count = static_cast<std::int32_t>(free.size());
  for (std::int32_t v = 0; v < patch.free_count; ++v) {
    number_[free[static_cast<std::size_t>(v)]] = v;
  }
  patch.offsets.assign(1, 0);
  for (const std::int32_t vertex : free) {
    for (const std::int32_t neighbour : rings_[vertex]) {
      if (number_[neighbour] < 0) {
        number_[neighbour] = patch.vertex_count();
        patch.vertices.push_back(neighbour);
      }
      patch.neighbours.push_back(number_[neighbour]);
    }
    patch.offsets.push_back(static_cast<std::int32_t>(patch.neighbours.size()));
  }

  // A triangle is numbered from its smallest corner; the others find it in that corner's ring.
  patch.around.assign(patch.neighbours.size(), -1);
  for (std::int32_t v = 0; v < patch.free_count; ++v) {
    const std::int32_t begin = patch.offsets[v];
    const std::int32_t end = patch.offsets[v + 1];
    for (std::int32_t k = begin; k < end; ++k) {
      const std::int32_t b = patch.neighbours[k];
      const std::int32_t c = patch.neighbours[k + 1 == end ? begin : k + 1];
      if (v < b && v < c) {
        patch.around[k] = patch.triangle_count();
        patch.triangles.push_back({v, b, c});
        continue;
      }
      const Triangle turned = canonical_corners(Triangle{v, b, c}, false);
      const std::int32_t first = patch.offsets[turned[0]];
      const std::int32_t last = patch.offsets[turned[0] + 1];
      for (std::int32_t j = first; j < last; ++j) {
        if (patch.neighbours[j] == turned[1] && patch.neighbours[j + 1 == last ? first : j + 1] == turned[2]) {
          patch.around[k] = patch.around[j];
          break;
        }
      }
    }
  }
  // From the corner on that the input numbers lowest, as everywhere: rounding gives slivers a sign that depends on it.
  for (Triangle& triangle : patch.triangles) {
    triangle = from_smallest(triangle, [&](std::int32_t v) { return rings_.input(patch.vertices[v]); });
  }
  for (const std::int32_t vertex : patch.vertices) {
    number_[vertex] = -1;
  }
  return patch;
}

}  // namespace trismooth
