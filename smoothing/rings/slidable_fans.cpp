// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/slidable_fans.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "trismooth/base/splitmix64.h"

namespace trismooth {

namespace {

/// One flag a vertex: whether it has no free neighbour.
std::vector<std::uint8_t> without_free_neighbour(std::span<const Triangle> triangles,
                                                 std::span<const std::uint8_t> is_free) {
  std::vector<std::uint8_t> found(is_free.size(), 1);
  for (const auto& [a, b, c] : triangles) {
    if ((is_free[a] | is_free[b] | is_free[c]) != 0) {
      found[a] = found[b] = found[c] = 0;
    }
  }
  return found;
}

}  // namespace

SlidableFans::SlidableFans(std::span<const Triangle> triangles, std::span<const std::uint8_t> may_slide,
                           std::span<const std::uint8_t> is_free, std::span<const std::int32_t> numbers)
    : begins_(may_slide.size() + 1, 0) {
  const auto slides = [&](std::int32_t v) { return may_slide[v] != 0; };
  for (const Triangle& triangle : triangles) {
    for (const std::int32_t v : triangle) {
      begins_[static_cast<std::size_t>(v) + 1] += slides(v) ? 1 : 0;
    }
  }
  for (std::size_t v = 1; v < begins_.size(); ++v) {
    begins_[v] += begins_[v - 1];
  }
  const std::vector<std::uint8_t> is_unknown = without_free_neighbour(triangles, is_free);
  const auto unknown = [&](std::int32_t v) { return is_unknown[v] != 0; };
  sides_.resize(begins_.back());
  std::vector<std::size_t> ends = begins_;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& triangle = triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      if (slides(triangle[i])) {
        const std::int32_t first = triangle[(i + 1) % 3];
        const std::int32_t second = triangle[(i + 2) % 3];
        sides_[ends[triangle[i]]++] = {first, second, static_cast<std::int32_t>(t), unknown(first), unknown(second)};
      }
    }
    if (std::ranges::none_of(triangle, [&](std::int32_t v) { return is_free[v] != 0; })) {
      held_triangles_.push_back(static_cast<std::int32_t>(t));
    }
  }
  std::vector<std::pair<std::uint64_t, std::int32_t>> order;
  for (std::size_t v = 0; v < may_slide.size(); ++v) {
    if (may_slide[v] != 0) {
      std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(begins_[v]),
                sides_.begin() + static_cast<std::ptrdiff_t>(begins_[v + 1]),
                [](const ListedSide& a, const ListedSide& b) {
                  return std::minmax({a.first, a.second}) < std::minmax({b.first, b.second});
                });
      order.emplace_back(splitmix64(static_cast<std::uint64_t>(numbers[v])), static_cast<std::int32_t>(v));
    }
  }
  std::ranges::sort(order);
  colouring_order_.reserve(order.size());
  for (const auto& [key, v] : order) {
    colouring_order_.push_back(v);
  }
}

}  // namespace trismooth
