// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/size_fit.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

struct FitSums {
  double areas = 0;
  double areas_asked = 0;
  std::int64_t elements = 0;
  std::int64_t left_out = 0;

  FitSums& operator+=(const FitSums& more) {
    areas += more.areas;
    areas_asked += more.areas_asked;
    elements += more.elements;
    left_out += more.left_out;
    return *this;
  }
};

/// The area asked for of an element, by that asked for around its corners.
double asked_area(const Triangle& corners, std::span<const double> inverse_areas) {
  const auto& [a, b, c] = corners;
  return 3 / (inverse_areas[a] + inverse_areas[b] + inverse_areas[c]);
}
double asked_area(const MixedElement& corners, std::span<const double> inverse_areas) {
  const auto& [a, b, c, d] = corners;
  return 2 * (4 / ((inverse_areas[a] + inverse_areas[c]) + (inverse_areas[b] + inverse_areas[d])));
}

template <class Corners>
SizeFit fit_of(const ElementView<Corners>& view, std::span<const double> inverse_areas,
               std::span<const std::uint8_t> held, int threads) {
  constexpr double not_compared = std::numeric_limits<double>::quiet_NaN();
  Workers workers(threads);
  std::vector<double> ratios(view.elements.size(), not_compared);
  const auto sums_of = [&](std::int64_t e) {
    return with_kind(canonical_corners(view, static_cast<std::size_t>(e)), [&](const auto& corners) -> FitSums {
      if (all_are_fixed(corners, held)) {
        return {};
      }
      const auto points = points_of(corners, view.points);
      if (!(shape_quotient(points) > 0)) {
        return {.left_out = 1};
      }
      const double area = doubled_area(points);
      const double asked = asked_area(corners, inverse_areas);
      ratios[e] = area / asked;
      return {area, asked, 1};
    });
  };
  const FitSums sums = ordered_sum(std::ssize(ratios), sums_of, workers);
  const double log_unit = std::log(sums.areas / sums.areas_asked);
  const auto square_of = [&](std::int64_t t) {
    const double log_ratio = std::isnan(ratios[t]) ? 0 : std::log(ratios[t]) - log_unit;
    return log_ratio * log_ratio;
  };
  const double squares = ordered_sum(std::ssize(ratios), square_of, workers);
  return {sums.elements, sums.left_out,
          sums.elements > 0 ? std::sqrt(squares / static_cast<double>(sums.elements)) : not_compared};
}

}  // namespace

SizeFit size_fit(const MeshView& view, std::span<const double> inverse_areas, std::span<const std::uint8_t> held,
                 int threads) {
  return view.visit([&](const auto& elements) { return fit_of(elements, inverse_areas, held, threads); });
}

}  // namespace trismooth
