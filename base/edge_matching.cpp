// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/edge_matching.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/splitmix64.h"

namespace trismooth {

namespace {

/// A halfedge in its part. Those of one edge have the same print; others seldom have.
struct Side {
  std::uint32_t print;
  std::int32_t halfedge;
};

constexpr int usual_part_bits = 14;  // so many corners: 128 KiB of sides and 256 KiB of table
constexpr std::int64_t most_parts = 4096;
constexpr std::int64_t matching_grain = 4096;

/// The vertices of a halfedge's edge.
struct Edge {
  std::int32_t from;
  std::int32_t to;

  bool is(Edge other) const { return (from == other.to && to == other.from) || (from == other.from && to == other.to); }
};

Edge edge_of(std::span<const Triangle> triangles, std::int32_t halfedge) {
  const Triangle& triangle = triangles[halfedge / 3];
  const std::int32_t i = halfedge % 3;
  return {triangle[i], triangle[i == 2 ? 0 : i + 1]};
}

/// The halfedges of one part that have been met, one of each edge.
class MetSides {
 public:
  MetSides(std::span<const Triangle> triangles, std::span<std::int32_t> twins) : triangles_(triangles), twins_(twins) {}

  void match(std::span<const Side> sides) {
    // Every edge of a manifold mesh is there twice, but for the boundary: half of the places stay free, and one always.
    const std::size_t places = std::bit_ceil(sides.size() + 1);
    met_.assign(places, {0, none});
    const auto mask = static_cast<std::uint32_t>(places - 1);
    for (const Side side : sides) {
      std::uint32_t place = side.print & mask;
      while (met_[place].halfedge != none && !is_same(met_[place], side)) {
        place = (place + 1) & mask;
      }
      if (met_[place].halfedge == none) {
        met_[place] = side;
        twins_[side.halfedge] = unpaired;
      } else {
        pair(met_[place].halfedge, side.halfedge);
      }
    }
  }

 private:
  static constexpr std::int32_t none = -1;

  bool is_same(Side a, Side b) const {
    return a.print == b.print && edge_of(triangles_, a.halfedge).is(edge_of(triangles_, b.halfedge));
  }

  /// The corner of its triangle that is not of its edge.
  std::int32_t apex(std::int32_t halfedge) const { return triangles_[halfedge / 3][(halfedge + 2) % 3]; }

  void pair(std::int32_t first, std::int32_t next) {
    const std::int32_t second = twins_[first];
    if (second == unpaired && apex(first) != apex(next)) {
      twins_[first] = next;
      twins_[next] = first;
      return;
    }
    if (second >= 0) {
      twins_[second] = one_of_many;
    }
    twins_[first] = one_of_many;
    twins_[next] = one_of_many;
  }

  std::span<const Triangle> triangles_;
  std::span<std::int32_t> twins_;
  std::vector<Side> met_;
};

}  // namespace

void match_edges(std::span<const Triangle> triangles, std::span<const std::int32_t> corner,
                 std::span<std::int32_t> twins, Workers& workers) {
  const auto count = static_cast<std::int64_t>(twins.size());
  int part_bits = usual_part_bits;
  while (count >> part_bits >= most_parts) {
    ++part_bits;
  }
  const std::int64_t parts = (count >> part_bits) + 1;
  // The part of each halfedge. To look corners up is what costs most, so it is done once.
  BulkVector<std::uint16_t> part_of(parts > 1 ? twins.size() : 0);
  if (parts > 1) {
    workers.for_blocks(std::ssize(triangles), matching_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = triangles[t];
        const std::array<std::int32_t, 3> lowest{corner[a], corner[b], corner[c]};
        for (std::size_t i = 0; i < 3; ++i) {
          const std::int32_t later = std::max(lowest[i], lowest[i == 2 ? 0 : i + 1]);
          part_of[3 * static_cast<std::size_t>(t) + i] = static_cast<std::uint16_t>(later >> part_bits);
        }
      }
    });
  }
  BulkVector<Side> sides(twins.size());
  const std::vector<std::int64_t> begins = counting_sort(
      count, parts, [&](std::int64_t h) { return parts > 1 ? part_of[h] : 0; },
      [&](std::int64_t h, std::int64_t place) {
        const auto [from, to] = edge_of(triangles, static_cast<std::int32_t>(h));
        const auto low = static_cast<std::uint64_t>(std::min(from, to));
        const auto high = static_cast<std::uint64_t>(std::max(from, to));
        sides[place] = {static_cast<std::uint32_t>(splitmix64(low << 32U | high) >> 32U), static_cast<std::int32_t>(h)};
      },
      workers);
  workers.for_blocks(parts, 1, [&](std::int64_t begin, std::int64_t end) {
    MetSides met(triangles, twins);
    for (std::int64_t part = begin; part < end; ++part) {
      met.match(std::span<const Side>(sides).subspan(static_cast<std::size_t>(begins[part]),
                                                     static_cast<std::size_t>(begins[part + 1] - begins[part])));
    }
  });
}

}  // namespace trismooth
