#include "trismooth/quality/quadratic_quality.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "trismooth/base/workers.h"

namespace trismooth {

QuadraticQuality quadratic_quality(const TriangleView& view, std::span<const QuadraticTriangle> elements, int threads) {
  constexpr std::int64_t grain = 4096;
  Workers workers(threads);
  QuadraticQuality all{std::ssize(elements), 0, std::numeric_limits<double>::infinity()};
  std::mutex joining;
  workers.for_blocks(std::ssize(elements), grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t invalid = 0;
    std::int64_t undecided = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::int64_t i = begin; i < end; ++i) {
      const QuadraticTriangle& element = elements[static_cast<std::size_t>(i)];
      const auto t = static_cast<std::size_t>(element.triangle);
      const bool is_reversed = !view.reversed.empty() && view.reversed[t] != 0;
      const JacobianBound bound =
          jacobian_bound(quadratic_nodes(view.triangles[t], element.middles, is_reversed, view.points));
      invalid += bound.is_invalid() ? 1 : 0;
      undecided += bound.is_valid() || bound.is_invalid() ? 0 : 1;
      smallest = std::min(smallest, bound.scaled());
    }
    const std::lock_guard lock(joining);
    all.invalid += invalid;
    all.undecided += undecided;
    all.min_jacobian = std::min(all.min_jacobian, smallest);
  });
  return all;
}

}  // namespace trismooth
