#pragma once

#include <cstdint>
#include <type_traits>

#include "trismooth/base/storage.h"
#include "trismooth/cuda/guard/commit.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth::cuda {

/// A CommitInput with one kind of rings, for kernels.
template <class ScalarType, Layout layout, class Rings>
struct CommitView {
  using Scalar = ScalarType;
  using Points = PointArrays<Scalar, layout>;

  Rings rings;                      ///< of the free vertices
  const std::int32_t* input_index;  ///< of all vertices
  const double2* before;
  Points first;
  Points second;
  const LoopState* state;
  bool is_over;
  const LocalFrame* frame;
  Storage storage;

  __device__ bool run_is_over() const { return is_over || state->stop != LoopState::running; }
  __device__ Points working() const { return state->current == 0 ? first : second; }
};

template <class T>
__device__ Point2<T> narrow(Point2<double> point) {
  return {static_cast<T>(point.x), static_cast<T>(point.y)};
}

/// A vertex as the commit sees it.
struct Corner {
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
        before_(view.before),
        working_(view.working()),
        frame_(*view.frame),
        storage_(view.storage) {}

  __device__ Point2<double> before(std::int32_t v) const {
    const double2 point = before_[v];
    return {point.x, point.y};
  }
  /// Where the file would have a vertex whose working position has changed.
  __device__ Point2<double> stored(Point2<T> working) const {
    const Point2<double> left =
        frame_.leave({static_cast<double>(working.x), static_cast<double>(working.y)}, largest_stored(storage_));
    return storage_ == Storage::float64 ? left
                                        : Point2<double>{static_cast<double>(static_cast<float>(left.x)),
                                                         static_cast<double>(static_cast<float>(left.y))};
  }
  __device__ Point2<double> stored(std::int32_t v) const { return stored(working_.load(v)); }
  /// The same in the local frame: what the commit evaluates.
  __device__ Point2<double> after(std::int32_t v, Point2<double> before) const {
    if (v >= free_count_) {
      return before;
    }
    const Point2<T> working = working_.load(v);
    return working == narrow<T>(before) ? before : frame_.enter(stored(working));
  }
  __device__ Corner corner(std::int32_t v) const {
    // Asked for first: it arrives while the positions are on their way.
    const std::int32_t input = input_index_[v];
    const Point2<double> old = before(v);
    return {old, after(v, old), input, v};
  }
  __device__ void take_back(std::int32_t v) const { working_.store(v, narrow<T>(before(v))); }

 private:
  std::int32_t free_count_;
  const std::int32_t* input_index_;
  const double2* before_;
  typename View::Points working_;
  LocalFrame frame_;
  Storage storage_;
};

struct Quotients {
  double before;
  double after;
};

/// canonical_quotient() of the element (a, b, c), before and after. The corner with the smallest input number is
/// brought to the front without branches, so that the threads of a warp divide together.
__device__ inline Quotients quotients(const Corner& a, const Corner& b, const Corner& c) {
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

/// Calls visit(own, b, c) for the elements (v, b, c) around the vertex whose corners have numbers from `lowest` on, of
/// which v is one. Each corner is looked at once, but for one.
template <class View, class Visit>
__device__ void for_elements(const View& view, const Positions<View>& positions, std::int32_t v, std::int32_t lowest,
                             Visit& visit) {
  const std::int32_t size = view.rings.ring_size(v);
  if (size == 0) {
    return;
  }
  const auto ring = view.rings.ring(v);
  const Corner own = positions.corner(v);
  Corner last{};
  bool has_last = false;
  std::int32_t number = ring[size - 1];
  for (std::int32_t i = 0; i <= size; ++i) {
    const std::int32_t following = ring[i < size ? i : 0];
    const bool counts = number >= lowest;
    Corner next{};
    if (counts) {
      next = positions.corner(number);
      if (has_last) {
        visit(own, last, next);
      }
    }
    last = next;
    has_last = counts;
    number = following;
  }
}

/// Calls body(view) with the input as kernels take it.
template <class T, Layout layout, class Body>
void with_view(const CommitInput<T, layout>& input, const Body& body) {
  const auto call = [&](const auto& rings) {
    body(CommitView<T, layout, std::remove_cvref_t<decltype(rings)>>{
        rings, input.rings->input_index.data(), reinterpret_cast<const double2*>(input.before), input.first,
        input.second, input.state, input.is_over, input.frame, input.storage});
  };
  if (input.rings->near_rings.records.size() > 0) {
    call(input.rings->near_rings.view());
  } else if (input.rings->wide_rings.records.size() > 0) {
    call(input.rings->wide_rings.view());
  } else {
    call(input.rings->rings.view());
  }
}

}  // namespace trismooth::cuda
