#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"

namespace trismooth {

/// Throws MeshError unless all vertices that cells use have one height z, to within 1e-6 of their extent along x and y.
/// `points` have three components and are finite, `pairs` are x and y of them. `fixed` answers why each vertex is fixed
/// (bits of namespace hold), which tells the vertices that nobody uses; it is asked only where heights differ at all.
/// Complexity: linear.
void require_one_height(const ConstPointView& points, std::span<const Point2<double>> pairs,
                        const std::function<std::vector<std::uint8_t>()>& fixed);

}  // namespace trismooth
