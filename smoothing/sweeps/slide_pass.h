#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/slide/slide_chains.h"
#include "trismooth/smoothing/slide/slide_targets.h"
#include "trismooth/smoothing/slide/slide_update.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth {

/// Slides the vertices of chains, in a run whose sweeps have working precision T. Each pass visits every slider once,
/// colour by colour, each in place: it sees what has moved before it, in Form A as well.
template <class T>
class SlidePass {
 public:
  /// `chains` outlive it.
  SlidePass(const SlideChains& chains, Workers& workers)
      : chains_(chains), view_(chains.view()), workers_(workers), places_(chains.places) {}

  /// Where the vertices are on their chains.
  std::span<SlidePlace> places() { return places_; }

  /// Makes ready for a run of the mean-ratio method from `points` (packed). `has_sizes`: sizes are asked for.
  void aim(std::span<const Point2<T>> points, const MeanRatioTargets<T>& targets, const MeanRatioMesh& mesh,
           bool has_sizes) {
    targets_.resize(chains_.sliders.size());
    const auto position = [&](std::int32_t v) { return widened(points[v]); };
    for (std::size_t s = 0; s < targets_.size(); ++s) {
      const Slider& slider = chains_.sliders[s];
      const double asked = has_sizes ? static_cast<double>(targets.inverse_areas[chains_.vertices[slider.knot]]) : 0;
      targets_[s] = fan_target(SlidingVertex(view_, view_places(), slider, position), mesh, asked);
    }
  }

  /// Where what a pass reads and writes is. A slider is visited where one of its vertices is marked in either list, or
  /// if `all`; where it moves, its vertices and their neighbours are marked in the first.
  struct Working {
    std::span<Point2<T>> points;
    std::span<Point2<T>> other_points;  ///< the other buffer of Form A, which is to know too; or empty
    std::span<std::uint8_t> marked;
    std::span<std::uint8_t> other_marked;  ///< or empty
    bool all;
    T tolerance;
  };

  template <class Update>
  SweepTally<T> run(const Update& method, const Working& working) {
    SweepTally<T> total;
    std::mutex joining;
    for (std::size_t batch = 0; batch + 1 < chains_.batches.size(); ++batch) {
      const std::int32_t first = chains_.batches[batch];
      workers_.for_blocks(chains_.batches[batch + 1] - first, grain, [&](std::int64_t begin, std::int64_t end) {
        SweepTally<T> tally;
        for (std::int64_t s = first + begin; s < first + end; ++s) {
          visit(method, static_cast<std::size_t>(s), working, tally);
        }
        const std::lock_guard lock(joining);
        total.join(tally);
      });
    }
    return total;
  }

  /// The smallest shape quotient of the triangles that no one-ring has.
  T smallest_quotient(std::span<const Point2<T>> points) const { return chains_.smallest_quotient(points); }

 private:
  static constexpr std::int64_t grain = 128;

  SlidePlaces view_places() { return {places_.data()}; }
  static Point2<double> widened(Point2<T> point) {
    return {static_cast<double>(point.x), static_cast<double>(point.y)};
  }

  bool take_mark(const Slider& slider, const Working& working) {
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

  template <class Update>
  void visit(const Update& method, std::size_t s, const Working& working, SweepTally<T>& tally) {
    const Slider& slider = chains_.sliders[s];
    if (!take_mark(slider, working)) {
      return;
    }
    ++tally.evaluated;
    const auto position = [&](std::int32_t v) { return widened(working.points[v]); };
    const SlidingVertex vertex(view_, view_places(), slider, position);
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
      mark(working.marked, side.from);
      mark(working.marked, side.to);
    });
    places_[slider.knot] = move.place;
  }

  static void mark(std::span<std::uint8_t> marked, std::int32_t v) {
    std::atomic_ref(marked[v]).store(1, std::memory_order_relaxed);
  }

  const SlideChains& chains_;
  SlideView view_;
  Workers& workers_;
  std::vector<SlidePlace> places_;
  std::vector<FanTarget> targets_;  ///< one a slider, of the mean-ratio method
};

}  // namespace trismooth
