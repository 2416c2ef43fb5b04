// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/slide/slide_chains.h"
#include "trismooth/smoothing/slide/slide_update.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth {

/// Slides the vertices of chains, in a run whose sweeps have working precision T, float or double. Each pass visits
/// every slider once, colour by colour, each in place: it sees what has moved before it, in Form A as well.
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
           bool has_sizes);

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

  /// One pass.
  SweepTally<T> run(const MethodInUse<T>& in_use, const Working& working);

  /// The smallest shape quotient of the elements that no one-ring has.
  T smallest_quotient(std::span<const Point2<T>> points) const { return chains_.smallest_quotient(points); }

 private:
  bool take_mark(const Slider& slider, const Working& working) const;
  template <class Update>
  void visit(const Update& method, std::size_t s, const Working& working, SweepTally<T>& tally);

  const SlideChains& chains_;
  SlideView view_;
  Workers& workers_;
  std::vector<SlidePlace> places_;
  std::vector<FanTarget> targets_;  ///< one a slider, of the mean-ratio method
};

}  // namespace trismooth
