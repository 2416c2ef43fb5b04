// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/slide/slide_update.h"

namespace trismooth {

/// How large an element of a fan is: see size_of(). Of a triangle with the third side as the difference of both others.
TRISMOOTH_HOST_DEVICE inline ElementSize<double> size_in_fan(const TriangleCorner<RingSpoke<double>>& corner) {
  const auto& [a, b] = corner;
  return {cross(a.edge, b.edge), a.squared + b.squared + squared_length(b.edge - a.edge)};
}
TRISMOOTH_HOST_DEVICE inline ElementSize<double> size_in_fan(const QuadrilateralCorner<RingSpoke<double>>& corner) {
  return size_of(corner);
}

/// What the mean-ratio method aims at around a slider, from the mesh as it is before the first sweep. `points(v)`: the
/// position of a packed vertex; `mesh`: what its free vertices have in common; `asked`: MeanRatioTargets::inverse_areas
/// of the vertex, where sizes are asked for, else 0.
template <class Points>
TRISMOOTH_HOST_DEVICE FanTarget fan_target(const SlidingVertex<Points>& vertex, const MeanRatioMesh& mesh,
                                           double asked) {
  double areas = 0;
  double largest_share = 0;
  int count = 0;
  struct Element {
    double area;
    double share;
  };
  vertex.for_sides(
      vertex.own(),
      [&](std::int32_t /*copy*/, Point2<double> position, const FanSide& side) {
        const auto [area, squares] =
            vertex.with_spokes(position, side, [](const auto& spokes) { return size_in_fan(spokes); });
        return Element{area, area > 0 ? share_of_error(area, squares) : 0};
      },
      [&](const Element& element) {
        ++count;
        areas += element.area > 0 ? element.area : 0;
        largest_share = element.share > largest_share ? element.share : largest_share;
      });
  const double mean_area = areas / static_cast<double>(count);
  if (asked > 0) {
    return {asked, growth_bound(largest_share, 1 / asked, mesh)};
  }
  return {inverse_target_area(mean_area, mesh), growth_bound(largest_share, mean_area, mesh)};
}

}  // namespace trismooth
