#include "trismooth/smoothing/rings/vertex_order.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_sort.h>

#include "trismooth/base/hilbert_curve.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t order_grain = 16384;
constexpr int curve_order = 15;  // 30 bits of curve and 1 of kind beside a 32-bit vertex number in one 64-bit key

}  // namespace

std::vector<std::int32_t> hilbert_order(std::span<const Point2<double>> points, const OneRings& rings,
                                        Workers& workers) {
  const auto count = static_cast<std::int64_t>(points.size());
  Point2<double> low{0, 0};
  Point2<double> high{0, 0};
  if (count > 0) {
    low = high = points[0];
  }
  for (const Point2<double> p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  // Vertices that no cell uses may be so near to each other, in a frame that is not theirs, that no number is large
  // enough.
  const double quotient = ((1 << curve_order) - 1) / extent;
  const double cells = std::isfinite(quotient) ? quotient : 0;
  std::vector<std::uint64_t> keys(points.size());
  workers.for_blocks(count, order_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      const auto x = static_cast<std::uint32_t>((points[v].x - low.x) * cells);
      const auto y = static_cast<std::uint32_t>((points[v].y - low.y) * cells);
      const std::uint64_t fixed = rings.is_free(static_cast<std::int32_t>(v)) ? 0 : 1;
      keys[v] = (fixed << 62U) | (hilbert_index(x, y, curve_order) << 32U) | static_cast<std::uint64_t>(v);
    }
  });
  if (workers.count() == 1 || count <= order_grain) {
    std::ranges::sort(keys);
  } else {
    workers.start();
    workers.run([&] { tbb::parallel_sort(keys.begin(), keys.end()); });
  }
  std::vector<std::int32_t> order(points.size());
  std::ranges::transform(keys, order.begin(),
                         [](std::uint64_t key) { return static_cast<std::int32_t>(key & 0xffffffffU); });
  return order;
}

}  // namespace trismooth
