#include "trismooth/smoothing/one_rings.h"

#include "trismooth/quality/triangle_quality.h"

namespace trismooth {

OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  return collect_one_rings(topology.vertex_count, fixed, workers, [&](std::int32_t vertex, const auto& callback) {
    const std::int32_t first = topology.corner[vertex];
    std::int32_t corner = first;
    do {
      callback(leading_neighbour(triangles, reversed, corner));
      corner = next_corner(topology, triangles, reversed, corner);
    } while (corner != first);
  });
}

double smallest_fixed_quotient(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                               std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle corners = canonical_corners(triangles[t], reversed[t] != 0);
    if (fixed[corners[0]] != 0 && fixed[corners[1]] != 0 && fixed[corners[2]] != 0) {
      smallest = std::min(smallest, shape_quotient(points[corners[0]], points[corners[1]], points[corners[2]]));
    }
  }
  return smallest;
}

}  // namespace trismooth
