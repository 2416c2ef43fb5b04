// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quadratic_quality.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/quality/quadratic_quadrilateral.h"
#include "trismooth/quality/quadratic_triangle.h"

namespace trismooth {

namespace {

/// The corners and then the middles, counter-clockwise from corner 0.
template <std::size_t nodes>
std::array<Point2<double>, nodes> nodes_of(std::span<const std::int32_t> corners, const QuadraticElement& element,
                                           bool is_reversed, std::span<const Point2<double>> points) {
  const std::size_t sides = corners.size();
  std::array<Point2<double>, nodes> found{};
  for (std::size_t i = 0; i < sides; ++i) {
    const std::int32_t corner = corners[is_reversed && i > 0 ? sides - i : i];
    const std::int32_t middle = element.middles[is_reversed ? sides - 1 - i : i];
    found[i] = points[static_cast<std::size_t>(corner)];
    found[sides + i] = points[static_cast<std::size_t>(middle)];
  }
  return found;
}

}  // namespace

JacobianBound jacobian_bound(const QuadraticElement& element, std::span<const std::int32_t> corners, bool is_reversed,
                             std::span<const Point2<double>> points) {
  if (corners.size() == 3) {
    return jacobian_bound(nodes_of<6>(corners, element, is_reversed, points));
  }
  auto nodes = nodes_of<9>(corners, element, is_reversed, points);
  nodes[8] =
      element.centre() == no_corner ? centre_of_eight(nodes) : points[static_cast<std::size_t>(element.centre())];
  return jacobian_bound(nodes);
}

std::pair<std::string_view, std::string_view> quadratic_words(const QuadraticQuality& found) {
  if (found.quadrilaterals == 0) {
    return {"triangle of six nodes", "triangles of six nodes"};
  }
  if (found.quadrilaterals == found.elements) {
    return {"quadrilateral of eight or nine nodes", "quadrilaterals of eight or nine nodes"};
  }
  return {"quadratic element", "quadratic elements"};
}

QuadraticQuality quadratic_quality(const MeshView& view, std::span<const QuadraticElement> elements, int threads) {
  constexpr std::int64_t grain = 4096;
  Workers workers(threads);
  return joined_blocks(
      std::ssize(elements), grain, workers,
      QuadraticQuality{.elements = std::ssize(elements), .min_jacobian = std::numeric_limits<double>::infinity()},
      [&](std::int64_t begin, std::int64_t end, QuadraticQuality& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const QuadraticElement& element = elements[static_cast<std::size_t>(i)];
          const auto e = static_cast<std::size_t>(element.element);
          const bool is_reversed = !view.reversed.empty() && view.reversed[e] != 0;
          const auto corners = view.elements[e];
          const JacobianBound bound = jacobian_bound(element, corners, is_reversed, view.points);
          found.quadrilaterals += corners.size() == 4 ? 1 : 0;
          found.invalid += bound.is_invalid() ? 1 : 0;
          found.undecided += bound.is_valid() || bound.is_invalid() ? 0 : 1;
          found.min_jacobian = std::min(found.min_jacobian, bound.scaled());
        }
      },
      [](QuadraticQuality& all, const QuadraticQuality& found) {
        all.quadrilaterals += found.quadrilaterals;
        all.invalid += found.invalid;
        all.undecided += found.undecided;
        all.min_jacobian = std::min(all.min_jacobian, found.min_jacobian);
      });
}

}  // namespace trismooth
