// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/slide/slide_chains.h"
#include "trismooth/smoothing/slide/slide_deviation.h"

namespace trismooth {

/// Whether sliding did harm: where it takes elements to about where T is all over the mesh, as on a regular grid, the
/// guard puts back one after the other, what had nothing to do with lines as well. `put_back`: vertices that went back;
/// `movable`: those that may move, free or on lines.
constexpr bool is_spoilt_by_sliding(std::int64_t put_back, std::int64_t movable) {
  return 4 * put_back > movable;
}

/// What the guard of the elements around free vertices has done.
struct ElementRounds {
  std::int64_t rounds = 0;
  double threshold = 0;    ///< GuardOutcome::threshold
  bool took_held = false;  ///< a vertex on a line is among those that went back
};

/// Lines and elements have their say in turn, until nobody has anything to say: who goes back for one may spoil the
/// other. `lines()` and `held_elements(threshold)`: the rounds of SlideGuard::settle() and settle_held_elements();
/// `elements()`: ElementRounds. Unless `guards`, lines alone are asked. Returns all rounds.
template <class Lines, class Elements, class HeldElements>
std::int64_t settle_in_turn(bool guards, const Lines& lines, const Elements& elements,
                            const HeldElements& held_elements) {
  std::int64_t rounds = 0;
  for (bool again = true; again;) {
    rounds += lines();
    again = false;
    if (guards) {
      const ElementRounds done = elements();
      const std::int64_t of_held = held_elements(done.threshold);
      rounds += done.rounds + of_held;
      again = done.took_held || of_held > 0;
    }
  }
  return rounds;
}

/// What comes of smoothed(true), with sliding; where that says that it is given up, of smoothed(false), and that it
/// was.
template <class Smoothed>
SmoothingResult with_sliding_unless_given_up(const Smoothed& smoothed) {
  SmoothingResult result = smoothed(true);
  if (result.sliding && result.sliding->given_up) {
    const SlidingResult given_up = *result.sliding;
    result = smoothed(false);
    result.sliding = given_up;
  }
  return result;
}

/// Judges vertices that have slid, in the coordinates as they are stored: what the never-worse guard is for elements of
/// one-rings, this is for lines, and for the elements that no one-ring has. Whoever is linked goes back together.
class SlideGuard {
 public:
  /// `places`: where the vertices are on their chains, by knot. `before` and `after` are all packed vertices as they
  /// were stored and as they would be, in the local frame. All outlive it.
  SlideGuard(const SlideChains& chains, std::span<SlidePlace> places, std::span<const Point2<double>> before,
             std::span<Point2<double>> after);

  /// Puts back in rounds what is not linked any more or beyond what lines allow, until nothing is. Vertices that
  /// somebody else has put back in `after` since are taken for what they are. Adds the vertices that went back to
  /// `reverted`. Returns the rounds. Complexity of a round: linear in the knots.
  std::int64_t settle(std::vector<std::int32_t>& reverted);

  /// Puts back in rounds what makes elements offend (see offends()), of which T is the smaller one of that of the
  /// others, GuardOutcome::threshold, and the smallest quotient before of those with a vertex that is elsewhere. Adds
  /// the vertices that went back to `reverted`. Returns the rounds. Where this takes rounds, lines and other elements
  /// are to be judged again. Complexity of a round: linear in the elements.
  std::int64_t settle_held_elements(double threshold_of_others, std::vector<std::int32_t>& reverted);

  /// What settle() found at last.
  const LineDeviation& deviation() const { return deviation_; }
  /// Vertices that are elsewhere on their chains.
  std::int64_t slid_vertices() const;

 private:
  bool has_slid(const Slider& slider) const;
  bool put_back(std::int32_t slider, std::vector<std::int32_t>& reverted);
  bool settle_links(std::vector<std::int32_t>& reverted);
  bool settle_lines(std::vector<std::int32_t>& reverted);
  bool put_back_held_elements(double threshold_of_others, std::vector<std::int32_t>& reverted);

  const SlideChains& chains_;
  SlideView view_;
  std::span<SlidePlace> places_;
  std::span<const Point2<double>> before_;
  std::span<Point2<double>> after_;
  LineDeviation deviation_;
  std::vector<std::int32_t> slider_at_;  ///< of each knot of the first copies; -1: it is an end
};

}  // namespace trismooth
