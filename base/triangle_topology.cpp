// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/triangle_topology.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <utility>

#include "trismooth/base/edge_matching.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/parity_forest.h"
#include "trismooth/base/prefix_sums.h"

namespace trismooth {

namespace {

constexpr std::int64_t topology_grain = 4096;

/// Checks the triangles, and finds the lowest corner of every vertex.
void find_corners(std::span<const Triangle> triangles, MatchedSides& sides, Workers& workers) {
  workers.for_blocks(sides.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(sides.corner.begin() + begin, sides.corner.begin() + end, -1);
  });
  std::atomic<bool> faulty{false};
  workers.for_blocks(std::ssize(triangles), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      if (is_faulty(sides.vertex_count, triangles[t])) {
        faulty = true;
        return;
      }
      for (std::int32_t i = 0; i < 3; ++i) {
        lower_relaxed(sides.corner[triangles[t][i]], static_cast<std::int32_t>(3 * t + i));
      }
    }
  });
  if (faulty) {
    check_triangles(sides.vertex_count, triangles);
  }
}

/// Takes edges between two ghosts for edges of many triangles: it is not known how many there are.
void part_at_ghosts(std::span<const Triangle> triangles, std::span<const std::uint8_t> ghosts, MatchedSides& sides,
                    Workers& workers) {
  workers.for_blocks(std::ssize(triangles), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (std::int32_t i = 0; i < 3; ++i) {
        if (ghosts[triangles[t][i]] != 0 && ghosts[triangles[t][(i + 1) % 3]] != 0) {
          sides.twins[3 * t + i] = MatchedSides::many_twins;
        }
      }
    }
  });
}

/// Marks isolated vertices and those of boundary and non-manifold edges.
void mark_held(std::span<const Triangle> triangles, MatchedSides& sides, Workers& workers) {
  workers.for_blocks(sides.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      sides.hold[v] = sides.corner[v] < 0 ? hold::isolated : std::uint8_t{0};
    }
  });
  workers.for_blocks(std::ssize(triangles), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (std::int32_t i = 0; i < 3; ++i) {
        if (const std::int32_t twin = sides.twins[3 * t + i]; twin < 0) {
          const std::uint8_t bit = twin == MatchedSides::no_twin ? hold::boundary : hold::non_manifold;
          set_bits_relaxed(sides.hold[triangles[t][i]], bit);
          set_bits_relaxed(sides.hold[triangles[t][(i + 1) % 3]], bit);
        }
      }
    }
  });
}

/// Whether the triangles on both sides of a halfedge are listed against each other (1) or alike (0): then they run
/// through their edge in opposite directions.
std::uint32_t are_against(std::span<const Triangle> triangles, std::int64_t halfedge, std::int32_t twin) {
  return triangles[halfedge / 3][halfedge % 3] == triangles[twin / 3][twin % 3] ? 1 : 0;
}

/// Joins the two triangles of every edge whose lower triangle is in [begin, end). False where an edge contradicts the
/// others.
bool join_neighbours(const ParityForest& forest, std::span<const Triangle> triangles,
                     std::span<const std::int32_t> twins, std::int64_t begin, std::int64_t end) {
  for (std::int64_t t = begin; t < end; ++t) {
    for (std::int64_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::int32_t twin = twins[h];
      if (twin > h && forest.join(static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(twin / 3),
                                  are_against(triangles, h, twin)) == ParityForest::Join::contradicted) {
        return false;
      }
    }
  }
  return true;
}

/// Throws the error of a component that cannot be oriented. Which edge contradicts the others depends on the order: the
/// one to name is found in that of the halfedges.
[[noreturn]] void throw_one_sided(const ParityForest& forest, std::span<const Triangle> triangles,
                                  std::span<const std::int32_t> twins) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    forest.plant(static_cast<std::uint32_t>(t));
  }
  std::int64_t h = 0;
  while (twins[h] <= h || forest.join(static_cast<std::uint32_t>(h / 3), static_cast<std::uint32_t>(twins[h] / 3),
                                      are_against(triangles, h, twins[h])) != ParityForest::Join::contradicted) {
    ++h;
  }
  throw MeshError("the triangles connected with triangle " + std::to_string(h / 3) +
                  " cannot be oriented consistently (a one-sided surface)");
}

void find_components(std::span<const Triangle> triangles, MatchedSides& sides, Workers& workers) {
  const std::int64_t count = std::ssize(triangles);
  BulkVector<std::uint32_t> words(triangles.size());
  const ParityForest forest{words.data()};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      forest.plant(static_cast<std::uint32_t>(t));
    }
  });
  std::atomic<bool> contradicted{false};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    if (!join_neighbours(forest, triangles, sides.twins, begin, end)) {
      contradicted = true;
    }
  });
  if (contradicted) {
    throw_one_sided(forest, triangles, sides.twins);
  }
  sides.parity.resize(triangles.size());
  sides.component.resize(triangles.size());
  std::atomic<bool> against{false};
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t any = 0;
    for (std::int64_t t = begin; t < end; ++t) {
      const auto root = forest.find(static_cast<std::uint32_t>(t));
      sides.parity[t] = static_cast<std::uint8_t>(root.parity);
      sides.component[t] = static_cast<std::int32_t>(root.element);
      any |= root.parity;
    }
    if (any != 0) {
      against = true;
    }
  });
  sides.alike = !against;
  // A root's word has served, and takes its component's number.
  sides.components = static_cast<std::int32_t>(for_each_numbered(
      count, [&](std::int64_t t) { return sides.component[t] == t; },
      [&](std::int64_t number, std::int64_t t) { words[t] = static_cast<std::uint32_t>(number); }, workers));
  workers.for_blocks(count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      sides.component[t] = static_cast<std::int32_t>(words[sides.component[t]]);
    }
  });
}

/// The corners of the fan that `first` is in.
template <class Corners>
std::int32_t fan_size(const Corners& corners, std::int32_t first) {
  std::int32_t size = 1;
  std::int32_t corner = corners.after(first);
  for (; corner >= 0 && corner != first; corner = corners.after(corner)) {
    ++size;
  }
  if (corner < 0) {
    // An open fan: walk to its other end as well.
    for (corner = corners.before(first); corner >= 0; corner = corners.before(corner)) {
      ++size;
    }
  }
  return size;
}

/// Calls visit(vertex, corner) for the lowest corner of every vertex. In the order of the triangles: files list them
/// with more locality than vertices.
template <class Visit>
void for_lowest_corners(std::span<const Triangle> triangles, const MatchedSides& sides, Workers& workers,
                        const Visit& visit) {
  workers.for_blocks(std::ssize(triangles), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t v = triangles[t][i];
        if (const auto corner = static_cast<std::int32_t>(3 * t + i); sides.corner[v] == corner) {
          visit(v, corner);
        }
      }
    }
  });
}

/// Counts the triangles of each vertex, and marks vertices whose triangles form more than one fan.
void find_fans(std::span<const Triangle> triangles, TriangleTopology& topology, Workers& workers) {
  topology.degree.resize(static_cast<std::size_t>(topology.vertex_count));
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(topology.degree.begin() + begin, topology.degree.begin() + end, 0);
  });
  with_corners(topology, triangles, topology.parity, workers, [&](const auto& corners) {
    for_lowest_corners(triangles, topology, workers,
                       [&](std::int32_t v, std::int32_t corner) { topology.degree[v] = fan_size(corners, corner); });
  });
  std::atomic<std::int64_t> in_fans{0};
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    in_fans.fetch_add(std::accumulate(topology.degree.begin() + begin, topology.degree.begin() + end, std::int64_t{0}),
                      std::memory_order_relaxed);
  });
  if (in_fans == 3 * std::ssize(triangles)) {
    return;
  }
  // There are corners outside of the first fans of their vertices.
  BulkVector<std::int32_t> fan = std::move(topology.degree);
  topology.degree.assign(static_cast<std::size_t>(topology.vertex_count), 0);
  workers.for_blocks(std::ssize(triangles), topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) {
      for (const std::int32_t v : triangles[t]) {
        std::atomic_ref(topology.degree[v]).fetch_add(1, std::memory_order_relaxed);
      }
    }
  });
  workers.for_blocks(topology.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      if (fan[v] != topology.degree[v]) {
        topology.hold[v] |= hold::bow_tie;
      }
    }
  });
}

}  // namespace

void check_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    for (const std::int32_t v : {a, b, c}) {
      if (v < 0 || v >= vertex_count) {
        throw_no_such_vertex(static_cast<std::int64_t>(t), std::to_string(v), vertex_count);
      }
    }
    if (a == b || b == c || c == a) {
      throw MeshError("triangle " + std::to_string(t) + " repeats a vertex");
    }
  }
}

Uniform uniform(std::span<const std::uint8_t> flags, Workers& workers) {
  std::atomic<bool> has_zero{false};
  std::atomic<bool> has_one{false};
  workers.for_blocks(std::ssize(flags), 8 * topology_grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t ones = 0;
    for (std::int64_t i = begin; i < end; ++i) {
      ones += flags[i] != 0 ? 1 : 0;
    }
    if (ones > 0) {
      has_one = true;
    }
    if (ones < end - begin) {
      has_zero = true;
    }
  });
  return {!has_one, !has_zero};
}

MatchedSides match_sides(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                         std::span<const std::uint8_t> ghosts) {
  check_mesh_size(vertex_count, std::ssize(triangles));
  MatchedSides sides;
  sides.vertex_count = vertex_count;
  sides.corner.resize(static_cast<std::size_t>(vertex_count));
  find_corners(triangles, sides, workers);
  sides.twins.resize(3 * triangles.size());
  match_edges(triangles, sides.corner, sides.twins, workers);
  if (!ghosts.empty()) {
    part_at_ghosts(triangles, ghosts, sides, workers);
  }
  sides.hold.resize(static_cast<std::size_t>(vertex_count));
  mark_held(triangles, sides, workers);
  find_components(triangles, sides, workers);
  return sides;
}

TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers,
                                   std::span<const std::uint8_t> ghosts) {
  TriangleTopology topology{match_sides(vertex_count, triangles, workers, ghosts), {}};
  find_fans(triangles, topology, workers);
  return topology;
}

}  // namespace trismooth
