// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/guard/stored_point.cuh"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth::cuda {

/// The input with one kind of rings, for kernels.
template <class T, class Rings>
struct GuardView : GuardInput<T> {
  using Scalar = T;

  Rings rings;  ///< of the free vertices

  __device__ bool run_is_over() const { return this->is_over || this->state->stop != LoopState::running; }
  __device__ PointArray<T> working() const { return this->state->current == 0 ? this->first : this->second; }
};

/// A vertex as the guard sees it.
struct JudgedVertex {
  Point2<double> before;
  Point2<double> after;
  std::int32_t input;   ///< the caller's number
  std::int32_t vertex;  ///< packed

  __device__ bool moved() const { return !(after == before); }
};

/// Where vertices are, in the local frame, and would be stored.
template <class View>
class Positions {
 public:
  using T = typename View::Scalar;

  __device__ explicit Positions(const View& view)
      : free_count_(view.rings.size),
        input_index_(view.input_index),
        before_(reinterpret_cast<const double2*>(view.before)),
        working_(view.working()),
        frame_(*view.frame),
        storage_(view.storage),
        held_(view.held.after) {}

  __device__ Point2<double> before(std::int32_t v) const {
    const double2 point = before_[v];
    return {point.x, point.y};
  }
  /// Where the file would have a vertex whose working position has changed.
  __device__ Point2<double> stored(Point2<T> working) const {
    return stored_point(frame_, {static_cast<double>(working.x), static_cast<double>(working.y)}, storage_);
  }
  __device__ Point2<double> stored(std::int32_t v) const { return stored(working_.load(v)); }
  /// Where the file would have it, in the local frame: what the guard evaluates.
  __device__ Point2<double> after(std::int32_t v, Point2<double> before) const {
    if (v >= free_count_) {
      return held_ == nullptr ? before : held_[v - free_count_];
    }
    const Point2<T> working = working_.load(v);
    return working == working_point<T>(before) ? before : frame_.enter(stored(working));
  }
  __device__ JudgedVertex judged(std::int32_t v) const {
    // Asked for first: it arrives while the positions are on their way.
    const std::int32_t input = input_index_[v];
    const Point2<double> old = before(v);
    return {old, after(v, old), input, v};
  }
  __device__ void take_back(std::int32_t v) const {
    if (v >= free_count_) {
      held_[v - free_count_] = before(v);
    } else {
      working_.store(v, working_point<T>(before(v)));
    }
  }

 private:
  std::int32_t free_count_;
  const std::int32_t* input_index_;
  const double2* before_;
  PointArray<T> working_;
  LocalFrame frame_;
  Storage storage_;
  Point2<double>* held_;  ///< see HeldView::after
};

struct Quotients {
  double before;
  double after;
};

/// An element around a vertex, with its corner there.
template <class Corner>
struct JudgedElement {
  JudgedVertex own;
  Corner corner;

  /// Calls visit(vertex) for all its vertices.
  template <class Visit>
  __device__ void for_each(const Visit& visit) const {
    visit(own);
    corner.for_each(visit);
  }
  __device__ bool moved() const {
    return own.moved() || !corner.all([](const JudgedVertex& other) { return !other.moved(); });
  }
};

/// The shape quotients of an element in canonical order, before and after. The corner with the smallest input number is
/// brought to the front without branches, so that the threads of a warp divide together.
__device__ inline Quotients quotients(const JudgedElement<TriangleCorner<JudgedVertex>>& element) {
  const JudgedVertex& a = element.own;
  const auto& [b, c] = element.corner;
  const bool a_first = a.input <= b.input && a.input <= c.input;
  const bool b_first = !a_first && b.input <= c.input;
  const auto pick = [&](Point2<double> if_a, Point2<double> if_b, Point2<double> if_c) {
    return Point2<double>{a_first ? if_a.x : (b_first ? if_b.x : if_c.x),
                          a_first ? if_a.y : (b_first ? if_b.y : if_c.y)};
  };
  const auto quotient = [&](Point2<double> p, Point2<double> q, Point2<double> r) {
    return shape_quotient(pick(p, q, r), pick(q, r, p), pick(r, p, q));
  };
  return {quotient(a.before, b.before, c.before), quotient(a.after, b.after, c.after)};
}

/// Those of a quadrilateral, turned by two corners and by one.
__device__ inline Quotients quotients(const JudgedElement<QuadrilateralCorner<JudgedVertex>>& element) {
  const JudgedVertex& a = element.own;
  const auto& [b, c, d] = element.corner;
  const bool by_two = min(c.input, d.input) < min(a.input, b.input);
  const bool by_one = by_two ? d.input < c.input : b.input < a.input;
  const auto either = [](bool first, Point2<double> if_first, Point2<double> if_not) {
    return Point2<double>{first ? if_first.x : if_not.x, first ? if_first.y : if_not.y};
  };
  const auto pick = [&](Point2<double> if_none, Point2<double> if_one, Point2<double> if_two, Point2<double> if_both) {
    return either(by_one, either(by_two, if_both, if_one), either(by_two, if_two, if_none));
  };
  const auto quotient = [&](Point2<double> p, Point2<double> q, Point2<double> r, Point2<double> s) {
    return shape_quotient(pick(p, q, r, s), pick(q, r, s, p), pick(r, s, p, q), pick(s, p, q, r));
  };
  return {quotient(a.before, b.before, c.before, d.before), quotient(a.after, b.after, c.after, d.after)};
}

/// Calls visit(element) for the elements around the vertex whose corners have numbers from `lowest` on, of which v is
/// one. Each corner is looked at once, but for one; those of a mesh with quadrilaterals more often. (A walk of
/// triangles' own beside for_elements_around(): many corners do not count, and a device need not wait for where these
/// are.)
template <class View, class Visit>
__device__ void for_elements(const View& view, const Positions<View>& positions, std::int32_t v, std::int32_t lowest,
                             Visit& visit) {
  const std::int32_t size = view.rings.ring_size(v);
  if (size == 0) {
    return;
  }
  const auto ring = view.rings.ring(v);
  const JudgedVertex own = positions.judged(v);
  if constexpr (MixedRing<decltype(ring)>) {
    for_elements_around(ring, [&](const auto& corner) {
      if (corner.all([&](std::int32_t number) { return number >= lowest; })) {
        const auto judged = corner.with([&](std::int32_t number) { return positions.judged(number); });
        visit(JudgedElement<std::remove_const_t<decltype(judged)>>{own, judged});
      }
    });
    return;
  }
  using Triangle = JudgedElement<TriangleCorner<JudgedVertex>>;
  JudgedVertex last{};
  bool has_last = false;
  std::int32_t number = ring[size - 1];
  for (std::int32_t i = 0; i <= size; ++i) {
    const std::int32_t following = ring[i < size ? i : 0];
    const bool counts = number >= lowest;
    JudgedVertex next{};
    if (counts) {
      next = positions.judged(number);
      if (has_last) {
        visit(Triangle{own, {last, next}});
      }
    }
    last = next;
    has_last = counts;
    number = following;
  }
}

}  // namespace trismooth::cuda
