#include "trismooth/base/triangle_topology.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "trismooth/base/errors.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/workers.h"

namespace trismooth {

namespace {

constexpr std::int64_t topology_grain = 4096;

struct HalfedgeEnd {
  std::int32_t larger;  ///< the edge's larger label; the smaller one names the bucket
  std::int32_t halfedge;
};

/// All halfedges, bucketed by the smaller label of their two vertices.
struct EdgeBuckets {
  std::vector<std::int32_t> offsets;  ///< bucket b holds ends[offsets[b] .. offsets[b + 1])
  std::vector<HalfedgeEnd> ends;
};

/// A label for each corner's vertex: the vertices numbered as the triangles first name them. Files number vertices at
/// random more often than triangles, so what is near in this numbering is near in memory too.
std::vector<std::int32_t> label_corners(std::int32_t vertex_count, std::span<const Triangle> triangles) {
  std::vector<std::int32_t> label(static_cast<std::size_t>(vertex_count), -1);
  std::vector<std::int32_t> labels(3 * triangles.size());
  std::int32_t next = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& own = label[triangles[t][i]];
      own = own < 0 ? next++ : own;
      labels[3 * t + i] = own;
    }
  }
  return labels;
}

EdgeBuckets bucket_edges(std::int32_t vertex_count, std::span<const Triangle> triangles) {
  const std::vector<std::int32_t> labels = label_corners(vertex_count, triangles);
  const auto halfedge_count = static_cast<std::int32_t>(labels.size());
  const auto ends_of = [&](std::int32_t h) { return std::minmax(labels[h], labels[h % 3 == 2 ? h - 2 : h + 1]); };
  EdgeBuckets buckets;
  buckets.offsets.assign(static_cast<std::size_t>(vertex_count) + 2, 0);
  for (std::int32_t h = 0; h < halfedge_count; ++h) {
    ++buckets.offsets[ends_of(h).first + 2];
  }
  for (std::size_t end = 2; end < buckets.offsets.size(); ++end) {
    buckets.offsets[end] += buckets.offsets[end - 1];
  }
  // While they are filled, offsets[b + 1] is where bucket b goes on; in the end, where it ends.
  buckets.ends.resize(labels.size());
  for (std::int32_t h = 0; h < halfedge_count; ++h) {
    const auto [smaller, larger] = ends_of(h);
    buckets.ends[buckets.offsets[smaller + 1]++] = {larger, h};
  }
  return buckets;
}

/// Pairs the halfedges of each edge, and marks the vertices of boundary and non-manifold edges.
void pair_edges(EdgeBuckets& buckets, std::span<const Triangle> triangles, MatchedSides& sides, Workers& workers) {
  const auto mark_ends = [&](std::int32_t h, std::uint8_t bit) {
    for (const std::int32_t vertex : {triangles[h / 3][h % 3], triangles[h / 3][(h % 3 + 1) % 3]}) {
      std::atomic_ref(sides.hold[vertex]).fetch_or(bit, std::memory_order_relaxed);
    }
  };
  workers.for_blocks(sides.vertex_count, topology_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      const auto bucket =
          std::span(buckets.ends).subspan(buckets.offsets[b], buckets.offsets[b + 1] - buckets.offsets[b]);
      std::ranges::sort(bucket, [](HalfedgeEnd x, HalfedgeEnd y) {
        return x.larger != y.larger ? x.larger < y.larger : x.halfedge < y.halfedge;
      });
      for (std::size_t i = 0; i < bucket.size();) {
        std::size_t j = i + 1;
        while (j < bucket.size() && bucket[j].larger == bucket[i].larger) {
          ++j;
        }
        if (j - i == 2) {
          sides.twins[bucket[i].halfedge] = bucket[i + 1].halfedge;
          sides.twins[bucket[i + 1].halfedge] = bucket[i].halfedge;
        } else {
          const bool single = j - i == 1;
          for (std::size_t k = i; k < j; ++k) {
            sides.twins[bucket[k].halfedge] = single ? MatchedSides::no_twin : MatchedSides::many_twins;
          }
          mark_ends(bucket[i].halfedge, single ? hold::boundary : hold::non_manifold);
        }
        i = j;
      }
    }
  });
}

/// Union-find over triangles that also knows whether a triangle is listed against its root.
class ParityForest {
 public:
  explicit ParityForest(std::size_t size) : parent_(size), parity_(size, 0) {
    for (std::size_t i = 0; i < size; ++i) {
      parent_[i] = static_cast<std::int32_t>(i);
    }
  }

  struct Root {
    std::int32_t triangle;
    std::uint8_t parity;
  };

  Root find(std::int32_t triangle) {
    std::uint8_t parity = 0;
    while (parent_[triangle] != triangle) {
      const std::int32_t up = parent_[triangle];
      parity ^= parity_[triangle];
      // Path halving: point at the grandparent, with the parity of both steps.
      parity_[triangle] ^= parity_[up];
      parent_[triangle] = parent_[up];
      parity ^= parity_[up];
      triangle = parent_[triangle];
    }
    return {triangle, parity};
  }

  /// Joins two triangles, listed alike (0) or against each other (1). The lower root stays, so every component's root
  /// is its lowest triangle. False where they are joined already the other way round.
  bool join(std::int32_t a, std::int32_t b, std::uint8_t against) {
    const Root root_a = find(a);
    const Root root_b = find(b);
    const auto parity = static_cast<std::uint8_t>(root_a.parity ^ root_b.parity ^ against);
    if (root_a.triangle == root_b.triangle) {
      return parity == 0;
    }
    const auto [low, high] = std::minmax(root_a.triangle, root_b.triangle);
    parent_[high] = low;
    parity_[high] = parity;
    return true;
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> parity_;
};

void find_components(std::span<const Triangle> triangles, MatchedSides& sides) {
  ParityForest forest(triangles.size());
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(sides.twins.size()); ++h) {
    const std::int32_t twin = sides.twins[h];
    if (twin > h) {
      // Two neighbours are listed alike if they run through their edge in opposite directions.
      const bool against = triangles[h / 3][h % 3] == triangles[twin / 3][twin % 3];
      if (!forest.join(h / 3, twin / 3, against ? 1 : 0)) {
        throw MeshError("the triangles connected with triangle " + std::to_string(h / 3) +
                        " cannot be oriented consistently (a one-sided surface)");
      }
    }
  }
  sides.parity.resize(triangles.size());
  sides.component.resize(triangles.size());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles.size()); ++t) {
    const auto root = forest.find(t);
    sides.parity[t] = root.parity;
    sides.component[t] = root.triangle == t ? sides.components++ : sides.component[root.triangle];
  }
}

void find_corners(std::span<const Triangle> triangles, TriangleTopology& topology) {
  topology.degree.assign(static_cast<std::size_t>(topology.vertex_count), 0);
  topology.corner.assign(static_cast<std::size_t>(topology.vertex_count), -1);
  for (std::int32_t t = static_cast<std::int32_t>(triangles.size()) - 1; t >= 0; --t) {
    for (std::int32_t i = 2; i >= 0; --i) {
      ++topology.degree[triangles[t][i]];
      topology.corner[triangles[t][i]] = 3 * t + i;
    }
  }
  for (std::int32_t v = 0; v < topology.vertex_count; ++v) {
    if (topology.corner[v] < 0) {
      topology.hold[v] |= hold::isolated;
    }
  }
}

/// The corners of the fan that `first` is in.
std::int32_t fan_size(const TriangleTopology& topology, std::span<const Triangle> triangles, std::int32_t first) {
  std::int32_t size = 1;
  std::int32_t corner = next_corner(topology, triangles, topology.parity, first);
  for (; corner >= 0 && corner != first; corner = next_corner(topology, triangles, topology.parity, corner)) {
    ++size;
  }
  if (corner < 0) {
    // An open fan: walk to its other end as well.
    corner = previous_corner(topology, triangles, topology.parity, first);
    for (; corner >= 0; corner = previous_corner(topology, triangles, topology.parity, corner)) {
      ++size;
    }
  }
  return size;
}

/// Marks vertices whose triangles form more than one fan. Walks in the order of the triangles: files list them with
/// more locality than vertices.
void find_bow_ties(std::span<const Triangle> triangles, TriangleTopology& topology, Workers& workers) {
  workers.for_blocks(
      static_cast<std::int64_t>(triangles.size()), topology_grain, [&](std::int64_t begin, std::int64_t end) {
        for (auto corner = static_cast<std::int32_t>(3 * begin); corner < 3 * end; ++corner) {
          const std::int32_t v = triangles[corner / 3][corner % 3];
          if (topology.corner[v] == corner && fan_size(topology, triangles, corner) != topology.degree[v]) {
            topology.hold[v] |= hold::bow_tie;
          }
        }
      });
}

}  // namespace

void check_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
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

MatchedSides match_sides(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers) {
  check_mesh_size(vertex_count, std::ssize(triangles));
  check_triangles(vertex_count, triangles);
  MatchedSides sides;
  sides.vertex_count = vertex_count;
  sides.twins.resize(3 * triangles.size());
  sides.hold.assign(static_cast<std::size_t>(vertex_count), 0);
  {
    EdgeBuckets buckets = bucket_edges(vertex_count, triangles);
    pair_edges(buckets, triangles, sides, workers);
  }
  find_components(triangles, sides);
  return sides;
}

TriangleTopology connect_triangles(std::int32_t vertex_count, std::span<const Triangle> triangles, Workers& workers) {
  TriangleTopology topology{match_sides(vertex_count, triangles, workers), {}, {}};
  find_corners(triangles, topology);
  find_bow_ties(triangles, topology, workers);
  return topology;
}

}  // namespace trismooth
