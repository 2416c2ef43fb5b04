// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/slidable_fans.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "trismooth/base/element_list.h"
#include "trismooth/base/splitmix64.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

/// One flag a vertex: whether it shares no element with a free one.
std::vector<std::uint8_t> without_free_neighbour(const ElementList& elements, std::span<const std::uint8_t> is_free) {
  std::vector<std::uint8_t> found(is_free.size(), 1);
  for (const std::span<const std::int32_t> corners : elements) {
    if (std::ranges::any_of(corners, [&](std::int32_t v) { return is_free[v] != 0; })) {
      std::ranges::for_each(corners, [&](std::int32_t v) { found[v] = 0; });
    }
  }
  return found;
}

}  // namespace

SlidableFans::SlidableFans(std::span<const MixedElement> elements, std::span<const std::uint8_t> may_slide,
                           std::span<const std::uint8_t> is_free, std::span<const std::int32_t> numbers)
    : begins_(may_slide.size() + 1, 0), is_unknown_(without_free_neighbour(elements, is_free)) {
  const auto slides = [&](std::int32_t v) { return may_slide[v] != 0; };
  for (const MixedElement& element : elements) {
    for (const std::int32_t v : corners_of(element)) {
      begins_[static_cast<std::size_t>(v) + 1] += slides(v) ? 1 : 0;
    }
  }
  for (std::size_t v = 1; v < begins_.size(); ++v) {
    begins_[v] += begins_[v - 1];
  }
  sides_.resize(begins_.back());
  std::vector<std::size_t> ends = begins_;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::span<const std::int32_t> corners = corners_of(elements[e]);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (slides(corners[i])) {
        sides_[ends[corners[i]]++] = {next_corner(corners, i), previous_corner(corners, i),
                                      corners.size() == 4 ? corners[(i + 2) % 4] : no_corner,
                                      static_cast<std::int32_t>(e)};
      }
    }
    if (std::ranges::none_of(corners, [&](std::int32_t v) { return is_free[v] != 0; })) {
      held_elements_.push_back(static_cast<std::int32_t>(e));
    }
  }
  const auto key = [](const ListedSide& side) {
    const auto [low, high] = std::minmax({side.first, side.second});
    return std::tuple(low, high, side.opposite);
  };
  std::vector<std::pair<std::uint64_t, std::int32_t>> order;
  for (std::size_t v = 0; v < may_slide.size(); ++v) {
    if (may_slide[v] != 0) {
      std::ranges::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begins_[v]),
                        sides_.begin() + static_cast<std::ptrdiff_t>(begins_[v + 1]), {}, key);
      order.emplace_back(splitmix64(static_cast<std::uint64_t>(numbers[v])), static_cast<std::int32_t>(v));
    }
  }
  std::ranges::sort(order);
  colouring_order_.reserve(order.size());
  for (const auto& [key_of_v, v] : order) {
    colouring_order_.push_back(v);
  }
}

}  // namespace trismooth
