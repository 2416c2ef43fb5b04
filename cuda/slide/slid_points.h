// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/smoothing/slide/slide_curve.h"

namespace trismooth::cuda {

/// Sliders on the device, and where their vertices are to be stored.
struct SlidPoints {
  SlideView view;
  SlidePlace* places;  ///< of the knots
  std::int32_t slider_count;
  std::int32_t free_count;
  Point2<double>* stored;  ///< one a knot of all copies: of those that are elsewhere on their chains
  Point2<double>* after;   ///< as HeldView
};

/// Finds slid.stored, and slid.after with it: the latter of the vertices that are not elsewhere, too. A slider that
/// would be stored where it was is put at its own knot; one of which a copy would be and another would not is noted in
/// the verdict as beyond. `before`: as GuardInput; `frame` is on the device.
void place_slid(const Context& context, const SlidPoints& slid, const Point2<double>* before, std::int32_t held_count,
                const LocalFrame* frame, Storage storage, LineVerdict* verdict);

/// Queues the judging of the edges of the lines and of `element_count` elements without a free vertex, which adds to
/// the verdict: what SlideGuard does on the host, but that nobody goes back.
void judge_lines(const Context& context, const SlidPoints& slid, const MixedElement* elements,
                 std::int32_t element_count, const Point2<double>* before, LineVerdict* verdict);

/// Queues the writing of those whose slid.after is not where they were to stored[input_index[v]]: where nobody has to
/// go back, as `state` and `verdict` say; null: in any case.
void write_slid(const Context& context, const SlidPoints& slid, const Point2<double>* before,
                const std::int32_t* input_index, Point2<double>* stored, const GuardState* state,
                const LineVerdict* verdict);

}  // namespace trismooth::cuda
