// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/one_rings.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "trismooth/base/machine/prefetch.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/rings/listed_rings.h"

namespace trismooth {

namespace {

constexpr std::int64_t rings_grain = 4096;

/// Whether the rings of a mesh in this orientation, and with these vertices fixed, are those that are listed.
bool are_as_listed(const ListedRings& listed, std::span<const std::uint8_t> reversed,
                   std::span<const std::uint8_t> fixed, Workers& workers) {
  std::atomic<bool> more_fixed{false};
  workers.for_blocks(std::ssize(fixed), rings_grain, [&](std::int64_t begin, std::int64_t end) {
    if (!std::equal(fixed.begin() + begin, fixed.begin() + end, listed.hold.begin() + begin,
                    [](std::uint8_t a, std::uint8_t b) { return (a != 0) == (b != 0); })) {
      more_fixed = true;
    }
  });
  return !more_fixed && uniform(reversed, workers).zeros;
}

/// Per vertex: 1 where its triangles are reversed.
BulkVector<std::uint8_t> flags_of_vertices(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                           std::span<const std::uint8_t> reversed, Workers& workers) {
  BulkVector<std::uint8_t> flags(static_cast<std::size_t>(vertex_count));
  workers.for_blocks(std::ssize(triangles), rings_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (const std::int32_t v : triangles[t]) {
        std::atomic_ref(flags[v]).store(reversed[t], std::memory_order_relaxed);
      }
    }
  });
  return flags;
}

/// The rings of the vertices that are free, the other way round where triangles are reversed.
OneRings changed_rings(const ListedRings& listed, std::span<const Triangle> triangles,
                       std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  const std::int32_t vertex_count = listed.rings.vertex_count();
  const BulkVector<std::uint8_t> turned = uniform(reversed, workers).zeros
                                              ? BulkVector<std::uint8_t>()
                                              : flags_of_vertices(vertex_count, triangles, reversed, workers);
  OneRings rings = OneRings::with_sizes(
      vertex_count, [&](std::int32_t v) { return fixed[v] == 0 ? listed.rings[v].size() : 0; }, workers);
  workers.for_blocks(vertex_count, rings_grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
      if (rings.is_free(v)) {
        const auto ring = rings.neighbours.begin() + rings.offsets[v];
        std::ranges::copy(listed.rings[v], ring);
        if (!turned.empty() && turned[v] != 0) {
          std::reverse(ring + 1, rings.neighbours.begin() + rings.offsets[v + 1]);
        }
      }
    }
  });
  return rings;
}

}  // namespace

OneRings one_rings(const TriangleTopology& topology, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  constexpr std::int64_t ahead = 24;  // corners
  OneRings rings = OneRings::with_sizes(
      topology.vertex_count, [&](std::int32_t v) { return fixed[v] == 0 ? topology.degree[v] : 0; }, workers);
  // In the order of the triangles: files list them with more locality than vertices.
  with_corners(topology, triangles, reversed, workers, [&](const auto& corners) {
    workers.for_blocks(std::ssize(triangles), rings_grain, [&](std::int64_t begin, std::int64_t end) {
      const auto lowest_at = [&](std::int64_t corner) {
        const std::int32_t v = triangles[corner / 3][corner % 3];
        return topology.corner[v] == corner && rings.is_free(v) ? v : -1;
      };
      for (std::int64_t first = 3 * begin; first < 3 * end; ++first) {
        // Vertices may be numbered at random: what is of them alone is asked for before it is needed.
        if (const std::int64_t later = first + 2 * ahead; later < 3 * end) {
          const std::int32_t v = triangles[later / 3][later % 3];
          prefetch(&topology.corner[v]);
          prefetch(&rings.offsets[v]);
        }
        if (const std::int64_t soon = first + ahead; soon < 3 * end) {
          if (const std::int32_t v = lowest_at(soon); v >= 0) {
            prefetch(&rings.neighbours[static_cast<std::size_t>(rings.offsets[v])]);
          }
        }
        if (const std::int32_t v = lowest_at(first); v >= 0) {
          rings.fill(v, [&, corner = static_cast<std::int32_t>(first)]() mutable {
            const std::int32_t neighbour = corners.leading(corner);
            corner = corners.after(corner);
            return neighbour;
          });
        }
      }
    });
  });
  return rings;
}

OneRings one_rings(const TriangleTopology& topology, std::span<const MixedElement> elements,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  OneRings rings = OneRings::with_sizes(
      topology.vertex_count, [&](std::int32_t v) { return fixed[v] == 0 ? topology.degree[v] : 0; }, workers);
  rings.opposites.resize(rings.neighbours.size());
  const auto opposite_of = [&](std::int32_t corner) {
    const MixedElement& element = elements[corner / 4];
    return element[3] == no_corner ? no_corner : element[(corner + 2) % 4];
  };
  with_corners(topology, elements, reversed, workers, [&](const auto& corners) {
    workers.for_blocks(topology.vertex_count, rings_grain, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        if (rings.is_free(v)) {
          rings.fill_mixed(v, [&, corner = topology.corner[v]]() mutable {
            const std::int32_t here = corner;
            corner = corners.after(corner);
            return std::pair(corners.leading(here), opposite_of(here));
          });
        }
      }
    });
  });
  return rings;
}

OneRings one_rings(const ListedRings& listed, std::span<const Triangle> triangles,
                   std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> fixed, Workers& workers) {
  return are_as_listed(listed, reversed, fixed, workers) ? listed.rings
                                                         : changed_rings(listed, triangles, reversed, fixed, workers);
}

OneRings one_rings(ListedRings&& listed, std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                   std::span<const std::uint8_t> fixed, Workers& workers) {
  return are_as_listed(listed, reversed, fixed, workers) ? std::move(listed.rings)
                                                         : changed_rings(listed, triangles, reversed, fixed, workers);
}

}  // namespace trismooth
