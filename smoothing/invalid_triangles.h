// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// Counts what SmoothingResult::inverted and SmoothingResult::degenerate say, of all elements t for which `counts(t)`,
/// an array of Triangle or of MixedElement, where position(v) is vertex v of the result in the local frame. `reversed`:
/// as MeshRings::reversed, of the input; what the untangling turned over, as the result has it, is turned. Complexity:
/// linear, on all workers.
template <class Elements, class Position, class Counts>
void count_invalid(const Elements& elements, std::span<const std::uint8_t> reversed, const Position& position,
                   const Counts& counts, Workers& workers, SmoothingResult& result) {
  constexpr std::int64_t element_grain = 8192;
  const std::span<const std::uint8_t> turned =
      result.untangling ? std::span<const std::uint8_t>(result.untangling->turned) : std::span<const std::uint8_t>();
  std::atomic<std::int64_t> inverted{0};
  std::atomic<std::int64_t> degenerate{0};
  workers.for_blocks(std::ssize(elements), element_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t inverted_here = 0;
    std::int64_t degenerate_here = 0;
    for (auto t = static_cast<std::size_t>(begin); t < static_cast<std::size_t>(end); ++t) {
      if (!counts(t)) {
        continue;
      }
      const bool is_turned = !turned.empty() && turned[t] != 0;
      const double quotient =
          with_kind(canonical_corners(elements[t], (reversed[t] != 0) != is_turned),
                    [&](const auto& corners) { return shape_quotient(points_of(corners, position)); });
      inverted_here += quotient < 0 ? 1 : 0;
      degenerate_here += quotient == 0 ? 1 : 0;
    }
    inverted.fetch_add(inverted_here, std::memory_order_relaxed);
    degenerate.fetch_add(degenerate_here, std::memory_order_relaxed);
  });
  result.inverted = inverted;
  result.degenerate = degenerate;
}

/// count_invalid() of all elements.
template <class Elements, class Position>
void count_invalid(const Elements& elements, std::span<const std::uint8_t> reversed, const Position& position,
                   Workers& workers, SmoothingResult& result) {
  count_invalid(
      elements, reversed, position, [](std::size_t) { return true; }, workers, result);
}

}  // namespace trismooth
