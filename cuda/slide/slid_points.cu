// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/guard/stored_point.cuh"
#include "trismooth/cuda/primitives/falling_key.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/slide/held_points.h"
#include "trismooth/cuda/slide/slid_points.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/guard/guard_rule.h"
#include "trismooth/smoothing/slide/slide_deviation.h"

namespace trismooth::cuda {

namespace {

/// Calls visit(slider, copy, knot, vertex) for the vertices of a slider that is elsewhere on its chain.
template <class Visit>
__device__ void for_slid(const SlidPoints& slid, std::uint32_t s, const Visit& visit) {
  const Slider slider = slid.view.sliders[s];
  if (slid.places[slider.knot].arc == slid.view.arcs[slider.knot]) {
    return;
  }
  const SlideChain chain = slid.view.chains[slider.chain];
  for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
    const std::int32_t knot = slider.knot + copy * chain.count;
    visit(slider, copy, knot, slid.view.vertices[knot]);
  }
}

struct PlaceSlid {
  SlidPoints slid;
  const Point2<double>* before;
  const LocalFrame* frame;
  Storage storage;
  LineVerdict* verdict;

  __device__ void operator()(std::uint32_t s) const {
    std::int32_t copies = 0;
    std::int32_t stored_where_they_were = 0;
    for_slid(slid, s, [&](const Slider& slider, std::int32_t copy, std::int32_t knot, std::int32_t v) {
      const ChainCurve curve(slid.view, slider.chain);
      const Point2<double> stored = stored_point(*frame, curve.position(slid.places[slider.knot], copy), storage);
      const Point2<double> after = frame->enter(stored);
      slid.stored[knot] = stored;
      slid.after[v - slid.free_count] = after;
      ++copies;
      stored_where_they_were += after == before[v] ? 1 : 0;
    });
    if (copies > 0 && stored_where_they_were == copies) {
      const Slider slider = slid.view.sliders[s];
      const ChainCurve curve(slid.view, slider.chain);
      slid.places[slider.knot] = curve.at_knot(slider.knot - curve.chain().first);
    } else if (stored_where_they_were > 0) {
      // (One goes back with the other.)
      atomicAdd(&verdict->beyond, 1U);
    }
  }
};

/// Both edges at a slider: the other end of one may slide, too, and it is looked at twice then, which does no harm.
struct JudgeLines {
  SlidPoints slid;
  const Point2<double>* before;
  LineVerdict* verdict;

  __device__ void operator()(std::uint32_t s) const {
    const Slider slider = slid.view.sliders[s];
    const ChainCurve curve(slid.view, slider.chain);
    const SlideChain& chain = curve.chain();
    const std::int32_t knot = slider.knot - chain.first;
    const auto after = [&](std::int32_t v) { return slid.after[v - slid.free_count]; };
    LineDeviation largest;
    for (const std::int32_t i : {knot > 0 ? knot - 1 : chain.count - 1, knot}) {
      const JudgedEdge edge = judge_edge(curve, slid.view, slid.places, i, after);
      largest.distance = max(largest.distance, edge.deviation.distance);
      largest.relative = max(largest.relative, edge.deviation.relative);
      if (!edge.is_good) {
        atomicAdd(&verdict->beyond, 1U);
      }
    }
    raise(&verdict->distance, largest.distance);
    raise(&verdict->relative, largest.relative);
    for_slid(slid, s, [&](const Slider& /*slider*/, std::int32_t /*copy*/, std::int32_t /*knot*/, std::int32_t v) {
      if (!(after(v) == before[v])) {
        atomicAdd(&verdict->slid, 1U);
      }
    });
  }

  static __device__ void raise(unsigned long long* word, double value) {
    // Most have nothing to add.
    const auto bits = static_cast<unsigned long long>(__double_as_longlong(value));
    if (bits > *static_cast<volatile unsigned long long*>(word)) {
      atomicMax(word, bits);
    }
  }
};

struct JudgeHeldElements {
  SlidPoints slid;
  const MixedElement* elements;
  const Point2<double>* before;
  LineVerdict* verdict;

  __device__ void operator()(std::uint32_t e) const {
    with_kind(elements[e], [&](const auto& corners) {
      const auto after = points_of(corners, [&](std::int32_t v) { return slid.after[v - slid.free_count]; });
      const auto was_at = points_of(corners, before);
      if (after == was_at) {
        return;
      }
      const double was = shape_quotient(was_at);
      atomicMax(&verdict->before, falling_key(was));
      atomicMax(&verdict->worsened, falling_key(worsened_quotient(was, shape_quotient(after))));
    });
  }
};

struct WriteSlid {
  SlidPoints slid;
  const Point2<double>* before;
  const std::int32_t* input_index;
  Point2<double>* stored;
  const GuardState* state;
  const LineVerdict* verdict;

  __device__ void operator()(std::uint32_t s) const {
    if (verdict != nullptr && !(state->nothing_offends() && verdict->is_good(state->all.before))) {
      return;
    }
    for_slid(slid, s, [&](const Slider& /*slider*/, std::int32_t /*copy*/, std::int32_t knot, std::int32_t v) {
      if (!(slid.after[v - slid.free_count] == before[v])) {
        Point2<double>& point = stored[input_index[v]];
        point = with_kept_bits(point, slid.stored[knot]);
      }
    });
  }
};

}  // namespace

void place_slid(const Context& context, const SlidPoints& slid, const Point2<double>* before, std::int32_t held_count,
                const LocalFrame* frame, Storage storage, LineVerdict* verdict) {
  copy_held(context, before, slid.free_count, held_count, slid.after);
  for_each(context, static_cast<std::uint32_t>(slid.slider_count), PlaceSlid{slid, before, frame, storage, verdict});
}

void judge_lines(const Context& context, const SlidPoints& slid, const MixedElement* elements,
                 std::int32_t element_count, const Point2<double>* before, LineVerdict* verdict) {
  for_each(context, static_cast<std::uint32_t>(slid.slider_count), JudgeLines{slid, before, verdict});
  for_each(context, static_cast<std::uint32_t>(element_count), JudgeHeldElements{slid, elements, before, verdict});
}

void write_slid(const Context& context, const SlidPoints& slid, const Point2<double>* before,
                const std::int32_t* input_index, Point2<double>* stored, const GuardState* state,
                const LineVerdict* verdict) {
  for_each(context, static_cast<std::uint32_t>(slid.slider_count),
           WriteSlid{slid, before, input_index, stored, state, verdict});
}

}  // namespace trismooth::cuda
