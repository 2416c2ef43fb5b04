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
#include "trismooth/base/triangle_topology.h"

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

template <class Elements>
Edge edge_of(const Elements& elements, std::int32_t halfedge) {
  const auto& element = elements[element_of_halfedge<Elements>(halfedge)];
  const std::int32_t i = corner_of_halfedge<Elements>(halfedge);
  return {element[i], element[i + 1 == corner_count(element) ? 0 : i + 1]};
}

/// What two elements on one edge have in common where they are copies of each other: their other corners, in any order.
std::int32_t other_corners(std::span<const Triangle> triangles, std::int32_t halfedge) {
  return triangles[halfedge / 3][(halfedge + 2) % 3];
}
std::array<std::int32_t, 2> other_corners(std::span<const MixedElement> elements, std::int32_t halfedge) {
  const std::int32_t last = start_of(elements, halfedge_before(elements, halfedge));
  if (corner_count(elements[halfedge / 4]) == 3) {
    return {last, no_corner};
  }
  const std::int32_t third = start_of(elements, halfedge_after(elements, halfedge_after(elements, halfedge)));
  return {std::max(third, last), std::min(third, last)};
}

/// The halfedges of one part that have been met, one of each edge.
template <class Elements>
class MetSides {
 public:
  MetSides(const Elements& elements, std::span<std::int32_t> twins) : elements_(elements), twins_(twins) {}

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
    return a.print == b.print && edge_of(elements_, a.halfedge).is(edge_of(elements_, b.halfedge));
  }

  void pair(std::int32_t first, std::int32_t next) {
    const std::int32_t second = twins_[first];
    if (second == unpaired && other_corners(elements_, first) != other_corners(elements_, next)) {
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

  Elements elements_;
  std::span<std::int32_t> twins_;
  std::vector<Side> met_;
};

template <class Elements>
void match(const Elements& elements, std::span<const std::int32_t> corner, std::span<std::int32_t> twins,
           Workers& workers) {
  constexpr std::int32_t stride = sides_of<Elements>;
  const auto count = static_cast<std::int64_t>(twins.size());
  int part_bits = usual_part_bits;
  while (count >> part_bits >= most_parts) {
    ++part_bits;
  }
  const std::int64_t parts = (count >> part_bits) + 1;
  // The part of each halfedge. To look corners up is what costs most, so it is done once.
  const bool has_parts = parts > 1 || stride != 3;
  const auto of_no_edge = static_cast<std::uint16_t>(parts);  // the fourth sides of triangles
  BulkVector<std::uint16_t> part_of(has_parts ? twins.size() : 0);
  if (has_parts) {
    workers.for_blocks(std::ssize(elements), matching_grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t e = begin; e < end; ++e) {
        const int corners = corner_count(elements[e]);
        std::array<std::int32_t, stride> lowest{};
        for (int i = 0; i < corners; ++i) {
          lowest[i] = corner[elements[e][i]];
        }
        for (int i = 0; i < stride; ++i) {
          const std::int32_t later = std::max(lowest[i], lowest[i + 1 < corners ? i + 1 : 0]);
          part_of[stride * e + i] = i < corners ? static_cast<std::uint16_t>(later >> part_bits) : of_no_edge;
          if (i >= corners) {
            twins[stride * e + i] = unpaired;
          }
        }
      }
    });
  }
  BulkVector<Side> sides(twins.size());
  const std::vector<std::int64_t> begins = counting_sort(
      count, parts + (stride == 3 ? 0 : 1), [&](std::int64_t h) { return has_parts ? part_of[h] : 0; },
      [&](std::int64_t h, std::int64_t place) {
        if (stride != 3 && part_of[h] == of_no_edge) {
          return;
        }
        const auto [from, to] = edge_of(elements, static_cast<std::int32_t>(h));
        const auto low = static_cast<std::uint64_t>(std::min(from, to));
        const auto high = static_cast<std::uint64_t>(std::max(from, to));
        sides[place] = {static_cast<std::uint32_t>(splitmix64(low << 32U | high) >> 32U), static_cast<std::int32_t>(h)};
      },
      workers);
  workers.for_blocks(parts, 1, [&](std::int64_t begin, std::int64_t end) {
    MetSides<Elements> met(elements, twins);
    for (std::int64_t part = begin; part < end; ++part) {
      met.match(std::span<const Side>(sides).subspan(static_cast<std::size_t>(begins[part]),
                                                     static_cast<std::size_t>(begins[part + 1] - begins[part])));
    }
  });
}

}  // namespace

void match_edges(std::span<const Triangle> triangles, std::span<const std::int32_t> corner,
                 std::span<std::int32_t> twins, Workers& workers) {
  match(triangles, corner, twins, workers);
}
void match_edges(std::span<const MixedElement> elements, std::span<const std::int32_t> corner,
                 std::span<std::int32_t> twins, Workers& workers) {
  match(elements, corner, twins, workers);
}

}  // namespace trismooth
