// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/slide/slide_view.h"

namespace trismooth::cuda {

/// What the device says of the lines that vertices are held to, and of the elements without a free vertex. All zeros
/// to begin with.
struct LineVerdict {
  unsigned long long distance;  ///< the bits of LineDeviation::distance, which rise with it...
  unsigned long long relative;  ///< ...and of relative
  unsigned long long before;    ///< as GuardKeys, of those elements...
  unsigned long long worsened;  ///< ...of which a vertex has moved
  std::uint32_t beyond;         ///< edges that are not good, and sliders of which a copy alone has moved
  std::uint32_t slid;           ///< vertices that are elsewhere, those of all copies

  /// Whether no line is beyond what is allowed.
  TRISMOOTH_HOST_DEVICE bool has_good_lines() const { return beyond == 0; }
  /// Whether nobody has to go back: no element offends, either. `others`: GuardKeys::before of the others.
  TRISMOOTH_HOST_DEVICE bool is_good(unsigned long long others) const {
    return has_good_lines() && worsened <= (before > others ? before : others);
  }
};

/// Vertices that have moved without having a ring, for the guard: those held to a line. On the device; all null where
/// there are none.
struct HeldView {
  Point2<double>* after = nullptr;       ///< of every vertex without a ring, in packed order, in the local frame
  const std::int32_t* fan_of = nullptr;  ///< the fan of each of them; -1: it does not slide
  const std::int32_t* fans = nullptr;    ///< as SlideView
  const FanSide* sides = nullptr;
  /// Where its lines are not good the guard changes nothing, and where it is not good nothing is written. Null: the
  /// host judges, and nothing is written before launch_writing().
  const LineVerdict* lines = nullptr;

  TRISMOOTH_HOST_DEVICE bool has_good_lines() const { return lines == nullptr || lines->has_good_lines(); }
};

}  // namespace trismooth::cuda
