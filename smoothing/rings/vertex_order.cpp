// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/vertex_order.h"

#include <algorithm>
#include <cmath>

#include "trismooth/base/box.h"
#include "trismooth/base/counting_sort.h"
#include "trismooth/base/hilbert_curve.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t order_grain = 16384;
constexpr int curve_order = 15;  // 30 bits of curve and 1 of kind make a key of 32 bits

Box bounding_box(std::span<const Point2<double>> points, Workers& workers) {
  return joined_blocks(
      std::ssize(points), order_grain, workers, Box{},
      [&](std::int64_t begin, std::int64_t end, Box& found) {
        for (std::int64_t v = begin; v < end; ++v) {
          found.add(points[v]);
        }
      },
      [](Box& all, const Box& found) { all.add(found); });
}

}  // namespace

BulkVector<std::int32_t> hilbert_order(std::span<const Point2<double>> points, const OneRings& rings,
                                       Workers& workers) {
  if (points.empty()) {
    return {};
  }
  const auto count = static_cast<std::int64_t>(points.size());
  const auto [low, high] = bounding_box(points, workers);
  const double extent = std::max(high.x - low.x, high.y - low.y);
  // Vertices that no cell uses may be so near to each other, in a frame that is not theirs, that no number is large
  // enough.
  const double quotient = ((1 << curve_order) - 1) / extent;
  const double cells = std::isfinite(quotient) ? quotient : 0;
  BulkVector<KeyedNumber> keyed(points.size());
  workers.for_blocks(count, order_grain, [&, low = low](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      const auto x = static_cast<std::uint32_t>((points[v].x - low.x) * cells);
      const auto y = static_cast<std::uint32_t>((points[v].y - low.y) * cells);
      const std::uint32_t fixed = rings.is_free(v) ? 0 : 1;
      keyed[v] = {fixed << (2U * curve_order) | static_cast<std::uint32_t>(hilbert_index(x, y, curve_order)), v};
    }
  });
  radix_sort(keyed, 2 * curve_order + 1, workers);
  BulkVector<std::int32_t> order(points.size());
  workers.for_blocks(count, order_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      order[v] = keyed[v].number;
    }
  });
  return order;
}

}  // namespace trismooth
