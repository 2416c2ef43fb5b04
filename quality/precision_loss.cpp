#include "trismooth/quality/precision_loss.h"

#include <atomic>
#include <cmath>

#include "trismooth/base/digits.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

namespace {

Point2<float> rounded(Point2<double> point) {
  return {static_cast<float>(point.x), static_cast<float>(point.y)};
}

}  // namespace

PrecisionLoss single_precision_loss(const TriangleView& view, int threads) {
  std::atomic<std::int64_t> collapsed{0};
  std::atomic<std::int64_t> distorted{0};
  const auto count = static_cast<std::int64_t>(view.triangles.size());
  constexpr std::int64_t grain = 4096;
  Workers(threads).for_blocks(count, grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t collapsed_here = 0;
    std::int64_t distorted_here = 0;
    for (std::int64_t t = begin; t < end; ++t) {
      const auto [i, j, k] = canonical_corners(view, static_cast<std::size_t>(t));
      const Point2<double> a = view.points[static_cast<std::size_t>(i)];
      const Point2<double> b = view.points[static_cast<std::size_t>(j)];
      const Point2<double> c = view.points[static_cast<std::size_t>(k)];
      const double exact = shape(a, b, c);
      const float in_single = shape(rounded(a), rounded(b), rounded(c));
      if (exact > 0 && !(in_single > 0)) {
        ++collapsed_here;
      } else if (!(std::abs(exact - static_cast<double>(in_single)) <= distortion_limit)) {
        ++distorted_here;
      }
    }
    collapsed.fetch_add(collapsed_here, std::memory_order_relaxed);
    distorted.fetch_add(distorted_here, std::memory_order_relaxed);
  });
  return {count, collapsed, distorted};
}

std::string describe(const PrecisionLoss& loss) {
  std::string lost;
  const auto add = [&](std::int64_t count, const std::string& what) {
    if (count > 0) {
      lost +=
          (lost.empty() ? "" : ", ") + what + ": " + std::to_string(count) + " of " + std::to_string(loss.triangles);
    }
  };
  add(loss.collapsed, "triangles that collapse");
  add(loss.distorted, "triangles whose shape changes by more than " + shortest_digits(distortion_limit));
  return "single precision cannot hold this mesh; rounded to it, " + lost;
}

}  // namespace trismooth
