// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/patch.h"

#include <cstddef>
#include <functional>

#include "trismooth/quality/element.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth {

namespace {

/// The number of an element that has one: its smallest corner, which comes first, finds it in its ring.
template <class Corners>
std::int32_t number_of(const Corners& element, const Patch& patch) {
  const std::span<const std::int32_t> ring = patch.rings()[element.front()];
  const std::span<const std::int32_t> around = patch.elements_around(element.front());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == element[1] && ring[i + 1 == ring.size() ? 0 : i + 1] == element.back()) {
      return around[i];
    }
  }
  return -1;
}

}  // namespace

PatchCutter::PatchCutter(const RingView& rings, std::int32_t vertex_count)
    : rings_(rings), number_(static_cast<std::size_t>(vertex_count), -1) {}

void PatchCutter::copy_rings(Patch& patch) {
  const auto numbered = [&](std::int32_t vertex) {
    if (vertex == no_corner) {
      return no_corner;
    }
    if (number_[vertex] < 0) {
      number_[vertex] = patch.vertex_count();
      patch.vertices.push_back(vertex);
    }
    return number_[vertex];
  };
  patch.offsets.assign(1, 0);
  for (std::int32_t v = 0; v < patch.free_count; ++v) {
    const std::int32_t vertex = patch.vertices[static_cast<std::size_t>(v)];
    for (const std::int32_t neighbour : rings_[vertex]) {
      patch.neighbours.push_back(numbered(neighbour));
    }
    if (rings_.has_quadrilaterals()) {
      for (const std::int32_t opposite : rings_.mixed(vertex).opposites) {
        patch.opposites.push_back(numbered(opposite));
      }
    }
    patch.offsets.push_back(std::ssize(patch.neighbours));
  }
}

Patch PatchCutter::cut(std::span<const std::int32_t> free) {
  Patch patch;
  patch.vertices.assign(free.begin(), free.end());
  patch.free_count = static_cast<std::int32_t>(free.size());
  for (std::int32_t v = 0; v < patch.free_count; ++v) {
    number_[free[static_cast<std::size_t>(v)]] = v;
  }
  copy_rings(patch);

  // An element is numbered from its smallest corner, which may move.
  patch.around.assign(patch.neighbours.size(), -1);
  const RingView rings = patch.rings();
  for (std::int32_t v = 0; v < patch.free_count; ++v) {
    std::int32_t* number = patch.around.data() + patch.offsets[v];
    const auto add = [&](const auto& corner) {
      const auto element = from_smallest(element_at(v, corner), std::identity());
      if (element.front() == v) {
        *number = patch.element_count();
        // From the corner on that the input numbers lowest, as everywhere: rounding gives slivers a sign that depends
        // on it.
        patch.elements.push_back(
            as_mixed(from_smallest(element, [&](std::int32_t w) { return rings_.input(patch.vertices[w]); })));
      } else {
        *number = number_of(element, patch);
      }
      ++number;
    };
    rings.with_ring(v, [&](const auto& ring) { for_elements_around(ring, add); });
  }
  for (const std::int32_t vertex : patch.vertices) {
    number_[vertex] = -1;
  }
  return patch;
}

}  // namespace trismooth
