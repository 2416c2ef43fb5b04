// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_quality.h"

#include <algorithm>
#include <limits>

#include "trismooth/base/machine/joined_blocks.h"

namespace trismooth {

QuadraticQuality quadratic_quality(const MeshView& view, std::span<const QuadraticTriangle> elements, int threads) {
  constexpr std::int64_t grain = 4096;
  Workers workers(threads);
  return joined_blocks(
      std::ssize(elements), grain, workers,
      QuadraticQuality{std::ssize(elements), 0, std::numeric_limits<double>::infinity()},
      [&](std::int64_t begin, std::int64_t end, QuadraticQuality& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const QuadraticTriangle& element = elements[static_cast<std::size_t>(i)];
          const auto t = static_cast<std::size_t>(element.triangle);
          const bool is_reversed = !view.reversed.empty() && view.reversed[t] != 0;
          const JacobianBound bound =
              jacobian_bound(quadratic_nodes(view.elements[t], element.middles, is_reversed, view.points));
          found.invalid += bound.is_invalid() ? 1 : 0;
          found.undecided += bound.is_valid() || bound.is_invalid() ? 0 : 1;
          found.min_jacobian = std::min(found.min_jacobian, bound.scaled());
        }
      },
      [](QuadraticQuality& all, const QuadraticQuality& found) {
        all.invalid += found.invalid;
        all.undecided += found.undecided;
        all.min_jacobian = std::min(all.min_jacobian, found.min_jacobian);
      });
}

}  // namespace trismooth
