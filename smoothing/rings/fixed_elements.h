// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/prefix_sums.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"

namespace trismooth {

/// The elements without a free vertex. No sweep sees them, and none changes them; but they count for the smallest shape
/// of the mesh, so a quality target above theirs is never reached.
class FixedElements {
 public:
  /// None.
  FixedElements() = default;

  /// Those of a mesh. `reversed`: one flag an element, as Orientation::reversed; `fixed`: one byte a vertex, 0 is free.
  /// `ghosts`: as MeshPart::ghosts, where it is a part of another mesh: then those whose first vertex it owns, so that
  /// each is in one part. Complexity: linear.
  FixedElements(const ElementList& elements, std::span<const std::uint8_t> reversed,
                std::span<const std::uint8_t> fixed, Workers& workers, std::span<const std::uint8_t> ghosts = {}) {
    elements.visit([&]<class Corners>(std::span<const Corners> all) {
      std::get<BulkVector<Corners>>(listed_) = listed(all, reversed, fixed, workers, ghosts);
    });
  }

  /// Their smallest shape quotient, where position(v) is vertex v in the local frame; infinite where there is none.
  template <class Position>
  double smallest_quotient(const Position& position) const {
    double smallest = std::numeric_limits<double>::infinity();
    for_quotients(position, [&](double quotient) { smallest = std::min(smallest, quotient); });
    return smallest;
  }

  /// How many of them are inverted or degenerate, where position(v) is vertex v in the local frame.
  template <class Position>
  std::int64_t inverted(const Position& position) const {
    std::int64_t count = 0;
    for_quotients(position, [&](double quotient) { count += quotient > 0 ? 0 : 1; });
    return count;
  }

 private:
  /// Those that count, in canonical order.
  template <class Corners>
  static BulkVector<Corners> listed(std::span<const Corners> elements, std::span<const std::uint8_t> reversed,
                                    std::span<const std::uint8_t> fixed, Workers& workers,
                                    std::span<const std::uint8_t> ghosts) {
    const auto counts = [&](const Corners& corners) {
      return all_are_fixed(corners, fixed) && (ghosts.empty() || ghosts[std::ranges::min(corners_of(corners))] == 0);
    };
    BulkVector<Corners> found;
    // Memory that is never touched costs nothing.
    found.resize(elements.size());
    const std::int64_t count = for_each_numbered(
        std::ssize(elements), [&](std::int64_t e) { return counts(elements[static_cast<std::size_t>(e)]); },
        [&](std::int64_t number, std::int64_t e) {
          found[static_cast<std::size_t>(number)] =
              canonical_corners(elements[static_cast<std::size_t>(e)], reversed[static_cast<std::size_t>(e)] != 0);
        },
        workers);
    found.resize(static_cast<std::size_t>(count));
    return found;
  }

  template <class Position, class Visit>
  void for_quotients(const Position& position, const Visit& visit) const {
    const auto visit_all = [&](const auto& all) {
      for (const auto& corners : all) {
        visit(quotient_at(corners, position));
      }
    };
    std::apply([&](const auto&... of_kind) { (visit_all(of_kind), ...); }, listed_);
  }

  /// As the mesh lists its elements; the other list is empty.
  std::tuple<BulkVector<Triangle>, BulkVector<MixedElement>> listed_;
};

}  // namespace trismooth
