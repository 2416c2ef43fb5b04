// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/precision_loss.h"

#include <cmath>
#include <cstdint>
#include <span>

#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/text/digits.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/quality/element.h"

namespace trismooth {

namespace {

Point2<float> rounded(Point2<double> point) {
  return {static_cast<float>(point.x), static_cast<float>(point.y)};
}

double shape_in_single(const Triangle& corners, std::span<const Point2<double>> points) {
  return static_cast<double>(shape(points_of(corners, [&](std::int32_t v) { return rounded(points[v]); })));
}
double shape_in_single(const MixedElement& corners, std::span<const Point2<double>> points) {
  return shape(points_of(corners, [&](std::int32_t v) {
    const Point2<float> point = rounded(points[v]);
    return Point2<double>{point.x, point.y};
  }));
}

}  // namespace

PrecisionLoss single_precision_loss(const MeshView& mesh, int threads) {
  constexpr std::int64_t grain = 4096;
  Workers workers(threads);
  return mesh.visit([&](const auto& view) {
    return joined_blocks(
        std::ssize(view.elements), grain, workers, PrecisionLoss{std::ssize(view.elements)},
        [&](std::int64_t begin, std::int64_t end, PrecisionLoss& loss) {
          for (std::int64_t e = begin; e < end; ++e) {
            with_kind(canonical_corners(view, static_cast<std::size_t>(e)), [&](const auto& corners) {
              const double exact = shape(points_of(corners, view.points));
              const double in_single = shape_in_single(corners, view.points);
              if (exact > 0 && !(in_single > 0)) {
                ++loss.collapsed;
              } else if (!(std::abs(exact - in_single) <= distortion_limit)) {
                ++loss.distorted;
              }
            });
          }
        },
        [](PrecisionLoss& all, const PrecisionLoss& loss) {
          all.collapsed += loss.collapsed;
          all.distorted += loss.distorted;
        });
  });
}

std::string describe(const PrecisionLoss& loss) {
  std::string lost;
  const auto add = [&](std::int64_t count, const std::string& what) {
    if (count > 0) {
      add_to_list(lost, what + ": " + std::to_string(count) + " of " + std::to_string(loss.elements));
    }
  };
  add(loss.collapsed, "elements that collapse");
  add(loss.distorted, "elements whose shape changes by more than " + shortest_digits(distortion_limit));
  return "single precision cannot hold this mesh; rounded to it, " + lost;
}

}  // namespace trismooth
