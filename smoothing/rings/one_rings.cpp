#include "trismooth/smoothing/rings/one_rings.h"

#include "trismooth/base/workers.h"

namespace trismooth {

OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  constexpr std::int64_t grain = 4096;
  OneRings rings = OneRings::with_sizes(topology.vertex_count,
                                        [&](std::int32_t v) { return fixed[v] == 0 ? topology.degree[v] : 0; });
  // In the order of the triangles: files list them with more locality than vertices.
  workers.for_blocks(static_cast<std::int64_t>(triangles.size()), grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto first = static_cast<std::int32_t>(3 * begin); first < 3 * end; ++first) {
      const std::int32_t v = triangles[first / 3][first % 3];
      if (topology.corner[v] == first && rings.is_free(v)) {
        rings.fill(v, [&, corner = first]() mutable {
          const std::int32_t neighbour = leading_neighbour(triangles, reversed, corner);
          corner = next_corner(topology, triangles, reversed, corner);
          return neighbour;
        });
      }
    }
  });
  return rings;
}

}  // namespace trismooth
