// SPDX-License-Identifier: BSD-3-Clause
// Incremental insertion (A. Bowyer 1981, D. F. Watson 1981) in the order of a Hilbert curve, for which both the walk to
// the next point and the work at it are O(1) on average (K. Buchin 2009, "Constructing Delaunay triangulations along
// space-filling curves"). The outside of the hull is triangulated too, by triangles of a hull edge and one ghost
// vertex at infinity (J. R. Shewchuk, "Lecture notes on Delaunay mesh generation", 3.4), so hull edges need no code of
// their own but the test of what a point outside conflicts with.

#include "trismooth/pipeline/generate/delaunay.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "trismooth/base/hilbert_curve.h"

namespace trismooth {

namespace {

constexpr std::int32_t ghost = -1;

/// Directed edges 3t, 3t+1 and 3t+2 are those of triangle t, counter-clockwise.
constexpr std::int32_t next_edge(std::int32_t edge) {
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}
constexpr std::int32_t previous_edge(std::int32_t edge) {
  return edge % 3 == 0 ? edge + 2 : edge - 1;
}

/// A Delaunay triangulation that grows point by point. Vertices are indices into the points it was given.
class GrowingTriangulation {
 public:
  /// Starts with the triangle (a, b, c), which is counter-clockwise. `points` must outlive this.
  GrowingTriangulation(std::span<const GridPoint> points, std::int32_t a, std::int32_t b, std::int32_t c);

  /// Adds vertex p, which coincides with no other.
  void insert(std::int32_t p);

  /// Calls function(a, b, c) for each triangle of the hull's inside.
  template <class Function>
  void for_each_triangle(Function&& function) const {
    for (std::size_t edge = 0; edge < origin_.size(); edge += 3) {
      const std::int32_t a = origin_[edge];
      const std::int32_t b = origin_[edge + 1];
      const std::int32_t c = origin_[edge + 2];
      if (a != ghost && b != ghost && c != ghost) {
        function(a, b, c);
      }
    }
  }

 private:
  /// An edge of the cavity's rim: the vertex it starts from, and its twin outside.
  struct RimEdge {
    std::int32_t origin;
    std::int32_t outer_edge;
  };

  void pair(std::int32_t edge, std::int32_t twin) {
    twin_[edge] = twin;
    twin_[twin] = edge;
  }
  bool is_right_of(std::int32_t edge, GridPoint p) const {
    return doubled_area(points_[origin_[edge]], points_[origin_[next_edge(edge)]], p) < 0;
  }
  std::int32_t locate(GridPoint p) const;
  bool conflicts(std::int32_t edge, GridPoint p) const;
  bool ghost_conflicts(std::int32_t a, std::int32_t b, GridPoint p) const;
  void dig_cavity(std::int32_t first_edge, GridPoint p);
  void fill_cavity(std::int32_t p);

  std::span<const GridPoint> points_;
  std::vector<std::int32_t> origin_;  ///< the vertex that each edge starts from
  std::vector<std::int32_t> twin_;    ///< the edge on each edge's other side
  std::int32_t latest_edge_ = 0;      ///< an edge between two points, of a triangle made last; walks start there
  // Of the insertion at work; members so that their memory is kept.
  std::vector<std::int32_t> pending_;  ///< edges of the cavity's triangles whose other side has not been looked at
  std::vector<std::int32_t> cavity_;   ///< triangles that conflict with the point
  std::vector<RimEdge> rim_;           ///< the cavity's outline, counter-clockwise
};

GrowingTriangulation::GrowingTriangulation(std::span<const GridPoint> points, std::int32_t a, std::int32_t b,
                                           std::int32_t c)
    : points_(points) {
  const std::size_t edges = 3 * (2 * points.size() - 2);  // by Euler's formula, ghost triangles included
  origin_.reserve(edges);
  twin_.reserve(edges);
  origin_ = {a, b, c, b, a, ghost, c, b, ghost, a, c, ghost};
  twin_.resize(origin_.size());
  for (std::int32_t side = 0; side < 3; ++side) {
    const std::int32_t outer = 3 + 3 * side;
    pair(side, outer);
    pair(outer + 2, 3 + 3 * ((side + 1) % 3) + 1);
  }
}

void GrowingTriangulation::insert(std::int32_t p) {
  dig_cavity(locate(points_[p]), points_[p]);
  fill_cavity(p);
}

/// An edge of a triangle that conflicts with p: of the one that holds p, or of a ghost triangle whose hull edge p lies
/// beyond. Steps through any edge that has p strictly beyond it; in a Delaunay triangulation that cannot run in
/// circles.
std::int32_t GrowingTriangulation::locate(GridPoint p) const {
  std::int32_t entry = is_right_of(latest_edge_, p) ? twin_[latest_edge_] : latest_edge_;
  while (origin_[previous_edge(entry)] != ghost) {
    if (const std::int32_t edge = next_edge(entry); is_right_of(edge, p)) {
      entry = twin_[edge];
    } else if (const std::int32_t other_edge = previous_edge(entry); is_right_of(other_edge, p)) {
      entry = twin_[other_edge];
    } else {
      break;
    }
  }
  return entry;
}

/// True where the triangle of `edge` cannot stay once p is there.
bool GrowingTriangulation::conflicts(std::int32_t edge, GridPoint p) const {
  const std::int32_t a = origin_[edge];
  const std::int32_t b = origin_[next_edge(edge)];
  const std::int32_t c = origin_[previous_edge(edge)];
  if (a == ghost) {
    return ghost_conflicts(b, c, p);
  }
  if (b == ghost) {
    return ghost_conflicts(c, a, p);
  }
  if (c == ghost) {
    return ghost_conflicts(a, b, p);
  }
  return in_circle(points_[a], points_[b], points_[c], p);
}

/// The circle through a, b and infinity is the half-plane left of ab. On the line itself only points of the edge
/// conflict, as they do with the triangle on its inner side.
bool GrowingTriangulation::ghost_conflicts(std::int32_t a, std::int32_t b, GridPoint p) const {
  const GridPoint from = points_[a];
  const GridPoint to = points_[b];
  const std::int64_t area = doubled_area(from, to, p);
  if (area != 0) {
    return area > 0;
  }
  const int axis = from[0] != to[0] ? 0 : 1;
  return (from[axis] < p[axis]) == (p[axis] < to[axis]);
}

/// Collects the triangles that conflict with p and their rim. They are connected, and no vertex lies in their midst
/// (every vertex keeps an edge), so they form a tree: none is reached twice, and a depth-first walk that takes each
/// triangle's edges counter-clockwise meets the rim in order.
void GrowingTriangulation::dig_cavity(std::int32_t first_edge, GridPoint p) {
  cavity_.assign(1, first_edge / 3);
  rim_.clear();
  pending_ = {previous_edge(first_edge), next_edge(first_edge), first_edge};
  while (!pending_.empty()) {
    const std::int32_t edge = pending_.back();
    pending_.pop_back();
    const std::int32_t outer_edge = twin_[edge];
    if (conflicts(outer_edge, p)) {
      cavity_.push_back(outer_edge / 3);
      pending_.push_back(previous_edge(outer_edge));
      pending_.push_back(next_edge(outer_edge));
    } else {
      rim_.push_back({origin_[edge], outer_edge});
    }
  }
}

/// Puts the triangles of p and each rim edge into the cavity: two more than were there.
void GrowingTriangulation::fill_cavity(std::int32_t p) {
  const auto triangles = static_cast<std::int32_t>(origin_.size() / 3);
  cavity_.push_back(triangles);
  cavity_.push_back(triangles + 1);
  origin_.resize(origin_.size() + 6);
  twin_.resize(origin_.size());
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const std::size_t next = i + 1 == rim_.size() ? 0 : i + 1;
    const std::int32_t edge = 3 * cavity_[i];
    origin_[edge] = p;
    origin_[edge + 1] = rim_[i].origin;
    origin_[edge + 2] = rim_[next].origin;
    pair(edge + 1, rim_[i].outer_edge);
    pair(edge + 2, 3 * cavity_[next]);
    if (rim_[i].origin != ghost && rim_[next].origin != ghost) {
      latest_edge_ = edge + 1;
    }
  }
}

std::string text_of(GridPoint point) {
  return "(" + std::to_string(point[0]) + ", " + std::to_string(point[1]) + ")";
}

/// The points' indices in the order of the Hilbert curve. Throws std::invalid_argument as delaunay() does.
std::vector<std::int32_t> hilbert_order(std::span<const GridPoint> points) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points[i];
    if (((x | y) >> grid_bits) != 0) {
      throw std::invalid_argument("point " + text_of(points[i]) + " lies outside the grid of 2^30 x 2^30");
    }
    sorted[i] = {hilbert_index(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), grid_bits),
                 static_cast<std::int32_t>(i)};
  }
  std::sort(sorted.begin(), sorted.end());
  const auto twice =
      std::adjacent_find(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice != sorted.end()) {
    throw std::invalid_argument("point " + text_of(points[twice->second]) + " occurs twice");
  }
  std::vector<std::int32_t> order(points.size());
  std::transform(sorted.begin(), sorted.end(), order.begin(), [](const auto& entry) { return entry.second; });
  return order;
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> delaunay(std::span<const GridPoint> points) {
  if (points.size() > (std::size_t{1} << 31) / 6) {
    throw std::length_error("a Delaunay triangulation of " + std::to_string(points.size()) +
                            " points has more edges than 32-bit indices can number");
  }
  std::vector<std::int32_t> order = hilbert_order(points);
  std::vector<GridPoint> sorted(points.size());
  const auto fetch = [points](std::int32_t index) { return points[index]; };
  std::transform(order.begin(), order.end(), sorted.begin(), fetch);

  const auto count = static_cast<std::int32_t>(sorted.size());
  std::int32_t apex = 2;  // the first point that makes a triangle with points 0 and 1
  while (apex < count && doubled_area(sorted[0], sorted[1], sorted[apex]) == 0) {
    ++apex;
  }
  if (apex >= count) {
    return {};
  }
  const bool left = doubled_area(sorted[0], sorted[1], sorted[apex]) > 0;
  GrowingTriangulation triangulation(sorted, left ? 0 : 1, left ? 1 : 0, apex);
  for (std::int32_t p = 2; p < count; ++p) {
    if (p != apex) {
      triangulation.insert(p);
    }
  }

  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(2 * points.size() - 5);  // by Euler's formula, at most
  triangulation.for_each_triangle([&](std::int32_t a, std::int32_t b, std::int32_t c) {
    triangles.push_back({order[a], order[b], order[c]});
  });
  return triangles;
}

}  // namespace trismooth
