// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/proposal.h"

namespace trismooth {

/// A method of the caller's own, for vertices in packed numbers and in the local frame: see one_ring_update.h.
template <class T>
class ProposedUpdate {
 public:
  /// `input_index`: the caller's number of each vertex. All outlive it.
  ProposedUpdate(const Proposal& proposal, const LocalFrame& frame, std::span<const std::int32_t> input_index)
      : proposal_(proposal), frame_(frame), input_index_(input_index), farthest_(farthest_of(frame)) {}

  template <class Ring>
  Move<T> update(std::int32_t v, Point2<T> position, const Ring& ring) const {
    const auto size = static_cast<std::size_t>(ring.size());
    Room<Point2<double>> neighbours(size);
    Room<std::int32_t> numbers(size);
    for (std::size_t i = 0; i < size; ++i) {
      neighbours.all[i] = left(ring[static_cast<int>(i)]);
      numbers.all[i] = input_index_[ring.number(static_cast<int>(i))];
    }
    VertexNeighbourhood around{input_index_[v], left(position), neighbours.all, numbers.all};
    const std::optional<Point2<double>> place = proposal_.place(around);
    if (!place || !std::isfinite(place->x) || !std::isfinite(place->y)) {
      return stay(position);
    }
    const Point2<double> entered = frame_.enter(*place);
    if (std::max(std::abs(entered.x), std::abs(entered.y)) >= farthest_) {
      return stay(position);
    }
    const Point2<T> target{static_cast<T>(entered.x), static_cast<T>(entered.y)};
    if (proposal_.accept == Acceptance::better_worst) {
      return smart_move(position, target, ring, worst_quotient(position, ring));
    }
    if (proposal_.accept == Acceptance::lower_energy) {
      const double before = proposal_.energy(around);
      around.position = left(target);
      if (!(proposal_.energy(around) < before)) {
        return stay(position);
      }
    }
    return move_to(position, target);
  }

 private:
  /// For what belongs to a ring: in place for nearly all of them.
  template <class V>
  struct Room {
    explicit Room(std::size_t size) : more(size <= few.size() ? 0 : size) {
      all = more.empty() ? std::span(few).first(size) : std::span(more);
    }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;
    ~Room() = default;

    std::array<V, 12> few{};
    std::vector<V> more;
    std::span<V> all;
  };

  /// Where all enters that is too far out for the frame: in another place than its own.
  static double farthest_of(const LocalFrame& frame) {
    constexpr double beyond = std::numeric_limits<double>::infinity();
    return frame.enter({beyond, beyond}).x;
  }

  Point2<double> left(Point2<T> position) const {
    return frame_.leave({static_cast<double>(position.x), static_cast<double>(position.y)});
  }

  const Proposal& proposal_;
  const LocalFrame& frame_;
  std::span<const std::int32_t> input_index_;
  double farthest_;
};

}  // namespace trismooth
