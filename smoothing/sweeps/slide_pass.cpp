// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/slide_pass.h"

#include <atomic>
#include <mutex>

#include "trismooth/smoothing/slide/slide_targets.h"

namespace trismooth {

namespace {

constexpr std::int64_t grain = 128;

template <class T>
Point2<double> widened(Point2<T> point) {
  return {static_cast<double>(point.x), static_cast<double>(point.y)};
}

void mark(std::span<std::uint8_t> marked, std::int32_t v) {
  std::atomic_ref(marked[v]).store(1, std::memory_order_relaxed);
}

}  // namespace

template <class T>
void SlidePass<T>::aim(std::span<const Point2<T>> points, const MeanRatioTargets<T>& targets, const MeanRatioMesh& mesh,
                       bool has_sizes) {
  targets_.resize(chains_.sliders.size());
  const auto position = [&](std::int32_t v) { return widened(points[v]); };
  for (std::size_t s = 0; s < targets_.size(); ++s) {
    const Slider& slider = chains_.sliders[s];
    const double asked = has_sizes ? static_cast<double>(targets.inverse_areas[chains_.vertices[slider.knot]]) : 0;
    targets_[s] = fan_target(SlidingVertex(view_, SlidePlaces{places_.data()}, slider, position), mesh, asked);
  }
}

template <class T>
SweepTally<T> SlidePass<T>::run(const MethodInUse<T>& in_use, const Working& working) {
  SweepTally<T> total;
  std::mutex joining;
  for (std::size_t batch = 0; batch + 1 < chains_.batches.size(); ++batch) {
    const std::int32_t first = chains_.batches[batch];
    workers_.for_blocks(chains_.batches[batch + 1] - first, grain, [&](std::int64_t begin, std::int64_t end) {
      SweepTally<T> tally;
      visit_method(in_use, [&](const auto& method) {
        for (std::int64_t s = first + begin; s < first + end; ++s) {
          visit(method, static_cast<std::size_t>(s), working, tally);
        }
      });
      const std::lock_guard lock(joining);
      total.join(tally);
    });
  }
  return total;
}

template <class T>
bool SlidePass<T>::take_mark(const Slider& slider, const Working& working) const {
  bool is_marked = working.all;
  chains_.for_copies(slider, [&](std::int32_t /*copy*/, std::int32_t v) {
    for (const std::span<std::uint8_t> marked : {working.marked, working.other_marked}) {
      if (!marked.empty()) {
        is_marked = is_marked || marked[v] != 0;
        marked[v] = 0;
      }
    }
  });
  return is_marked;
}

template <class T>
template <class Update>
void SlidePass<T>::visit(const Update& method, std::size_t s, const Working& working, SweepTally<T>& tally) {
  const Slider& slider = chains_.sliders[s];
  if (!take_mark(slider, working)) {
    return;
  }
  ++tally.evaluated;
  const auto position = [&](std::int32_t v) { return widened(working.points[v]); };
  const SlidingVertex vertex(view_, SlidePlaces{places_.data()}, slider, position);
  const FanTarget target = targets_.empty() ? FanTarget{} : targets_[s];
  const SlideMove move = slide(method, vertex, target);
  if (!move.moved) {
    return;
  }
  add_move(tally, MoveLength<T>{static_cast<T>(move.moved_squares), static_cast<T>(move.squares)}, working.tolerance);
  chains_.for_copies(slider, [&](std::int32_t copy, std::int32_t v) {
    const Point2<double> place = vertex.curve().position(move.place, copy);
    working.points[v] = {static_cast<T>(place.x), static_cast<T>(place.y)};
    if (!working.other_points.empty()) {
      working.other_points[v] = working.points[v];
    }
    mark(working.marked, v);
  });
  chains_.for_sides(slider, [&](std::int32_t /*v*/, const FanSide& side) {
    side.for_each([&](std::int32_t other) { mark(working.marked, other); });
  });
  places_[slider.knot] = move.place;
}

template class SlidePass<float>;
template class SlidePass<double>;

}  // namespace trismooth
