// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/packed_slidable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace trismooth {

PackedSlidable::PackedSlidable(Slidable slidable, std::span<const std::uint8_t> reversed,
                               std::vector<std::int32_t> numbers)
    : slidable_(std::move(slidable)),
      elements_(slidable_, reversed),
      numbers_(std::move(numbers)),
      packed_elements_(elements_.renumbered(numbers_)) {}

SlideChains PackedSlidable::chains(std::span<const Point2<double>> stored, Storage storage,
                                   const LocalFrame& frame) const {
  std::vector<Point2<double>> points(stored.size());
  std::vector<double> roundings(stored.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = frame.enter(stored[i]);
    // A coordinate is stored to half a unit in its last place; that of the smallest numbers has a size of its own.
    const double farthest = std::max(std::abs(stored[i].x), std::abs(stored[i].y));
    const double half_unit =
        storage == Storage::float64 ? std::max(0x1p-53 * farthest, 0x1p-1074) : std::max(0x1p-24 * farthest, 0x1p-149);
    // Of both axes, and of three vertices:
    roundings[i] = 4 * local_frame_details::scaled(half_unit, -frame.exponent);
  }
  return find_slide_chains(slidable_, elements_, {points, roundings});
}

std::vector<std::int32_t> packed_numbers(const Slidable& slidable, std::span<const std::int32_t> input_index) {
  constexpr std::int32_t not_one = -1;
  std::vector<std::int32_t> places(input_index.size(), not_one);
  for (std::int32_t i = 0; i < slidable.vertex_count(); ++i) {
    places[static_cast<std::size_t>(slidable.vertices[static_cast<std::size_t>(i)])] = i;
  }
  std::vector<std::int32_t> numbers(slidable.vertices.size());
  for (std::size_t v = 0; v < input_index.size(); ++v) {
    if (const std::int32_t place = places[static_cast<std::size_t>(input_index[v])]; place != not_one) {
      numbers[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(v);
    }
  }
  return numbers;
}

}  // namespace trismooth
