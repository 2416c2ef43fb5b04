// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/topology/component_votes.cuh"
#include "trismooth/cuda/topology/orientation.h"
#include "trismooth/quality/orientation_sign.h"

namespace trismooth::cuda {

namespace {

/// An element's vote on whether its component is listed counter-clockwise, as its first element is listed.
template <class List>
struct SignVotes {
  List elements;
  const Point2<double>* points;
  const std::uint32_t* words;

  TRISMOOTH_HOST_DEVICE Vote operator()(std::uint32_t e) const {
    const std::uint32_t word = words[e];
    const double sign = orientation_sign(canonical_corners(elements[e], (word & 1U) != 0), points);
    return {word >> 1U, sign > 0, sign < 0, sign != 0, !(sign > 0)};
  }
};

struct TurnComponent {
  VoteCounts counts;
  std::uint8_t* turned;
  std::uint32_t* changed;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t component) const {
    const std::int32_t margin = counts.margins[component];
    const std::uint32_t tie_breaker = counts.tie_breakers[component];
    const bool turn = margin != 0 ? margin < 0 : tie_breaker != VoteCounts::nobody && (tie_breaker & 1U) != 0;
    if (turned[component] != (turn ? 1 : 0)) {
      turned[component] = turn ? 1 : 0;
      set_bits(changed, 1);
    }
  }
};

struct OrientElement {
  const std::uint32_t* words;
  const std::uint8_t* turned;
  std::uint8_t* reversed;

  TRISMOOTH_HOST_DEVICE void operator()(std::uint32_t e) const {
    const std::uint32_t word = words[e];
    reversed[e] = static_cast<std::uint8_t>((word & 1U) ^ turned[word >> 1U]);
  }
};

}  // namespace

template <class List>
bool orient(Context& context, const List& elements, const Point2<double>* points, const Components& components,
            DeviceOrientation& orientation) {
  const auto element_count = static_cast<std::uint32_t>(elements.count);
  const auto component_count = static_cast<std::size_t>(components.count);
  const bool is_first = !orientation.is_known;
  if (element_count == 0) {
    orientation.is_known = true;
    return is_first;
  }
  if (is_first) {
    orientation.turned = DeviceBuffer<std::uint8_t>(context, component_count);
    orientation.turned.fill_bytes(0);
    orientation.reversed = DeviceBuffer<std::uint8_t>(context, element_count);
  }
  const std::uint32_t* const words = components.words.data();
  DeviceBuffer<std::uint32_t> changed(context, 1);
  changed.fill_bytes(0);
  {
    DeviceBuffer<std::int32_t> margins(context, component_count);
    DeviceBuffer<std::uint32_t> tie_breakers(context, component_count);
    margins.fill_bytes(0);
    tie_breakers.fill_bytes(0xFF);
    const VoteCounts counts{margins.data(), tie_breakers.data()};
    count_votes(context, element_count, SignVotes<List>{elements, points, words}, counts);
    for_each(context, static_cast<std::uint32_t>(component_count),
             TurnComponent{counts, orientation.turned.data(), changed.data()});
  }
  if (download(context, changed.data()) == 0 && !is_first) {
    return false;
  }
  for_each(context, element_count, OrientElement{words, orientation.turned.data(), orientation.reversed.data()});
  orientation.is_known = true;
  return true;
}

template bool orient(Context&, const TriangleList&, const Point2<double>*, const Components&, DeviceOrientation&);
template bool orient(Context&, const MixedList&, const Point2<double>*, const Components&, DeviceOrientation&);

}  // namespace trismooth::cuda
