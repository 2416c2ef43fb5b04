// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/slid_vertices.h"

#include <algorithm>
#include <cstddef>

#include "trismooth/smoothing/slide/slide_curve.h"

namespace trismooth {

SlidVertices::SlidVertices(const SlideChains& chains, std::span<const SlidePlace> places, const LocalFrame& frame,
                           Storage storage) {
  const SlideView view = chains.view();
  slid_.reserve(chains.vertices.size());
  for (const Slider& slider : chains.sliders) {
    const SlidePlace& place = places[static_cast<std::size_t>(slider.knot)];
    if (place.arc == chains.places[static_cast<std::size_t>(slider.knot)].arc) {
      continue;
    }
    const ChainCurve curve(view, slider.chain);
    chains.for_copies(slider, [&](std::int32_t copy, std::int32_t v) {
      slid_.push_back({v, rounded_to(storage, frame.leave(curve.position(place, copy), largest_stored(storage)))});
    });
  }
}

const SlidVertex* SlidVertices::find(std::int32_t vertex) {
  if (!is_sorted_) {
    std::ranges::sort(slid_, {}, &SlidVertex::vertex);
    is_sorted_ = true;
  }
  const auto found = std::ranges::lower_bound(slid_, vertex, {}, &SlidVertex::vertex);
  return found != slid_.end() && found->vertex == vertex ? &*found : nullptr;
}

}  // namespace trismooth
