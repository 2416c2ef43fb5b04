// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/triangle_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/hilbert_curve.h"

namespace trismooth {

namespace {

constexpr std::size_t triangles_a_leaf = 8;
constexpr std::size_t children_a_node = 4;

/// Where a number of the local frame, which is within [-4, 4], is among 2^32 steps.
std::uint32_t step_of(double coordinate) {
  constexpr double steps = 0x1p29;
  return static_cast<std::uint32_t>(std::clamp((coordinate + 4) * steps, 0.0, 0x1p32 - 1));
}

std::array<Point2<double>, 3> corners_of(std::span<const Point2<double>> points, const Triangle& triangle) {
  return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
}

double beyond(double low, double high, double value) {
  return value < low ? low - value : (value > high ? value - high : 0);
}

double squared_distance(const Box& box, Point2<double> point) {
  return squared_length(Point2<double>{beyond(box.low.x, box.high.x, point.x), beyond(box.low.y, box.high.y, point.y)});
}

}  // namespace

struct TriangleTree::Search {
  Point2<double> at;
  std::span<const std::int32_t> regions;
  std::int32_t region = 0;
  MeshPlace best = {};
  double squared_distance = std::numeric_limits<double>::infinity();
};

TriangleTree::TriangleTree(std::span<const Point2<double>> points, std::span<const Triangle> triangles)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> along_curve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = corners_of(points, triangles[t]);
    const Point2<double> centre{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    along_curve[t] = {hilbert_index(step_of(centre.x), step_of(centre.y)), static_cast<std::int32_t>(t)};
  }
  std::ranges::sort(along_curve);
  std::vector<Box> boxes((triangles.size() + triangles_a_leaf - 1) / triangles_a_leaf);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    order_[i] = along_curve[i].second;
    Box& box = boxes[i / triangles_a_leaf];
    const auto corners = corners_of(points, triangles[order_[i]]);
    for (const Point2<double> corner : corners) {
      box.add(corner);
    }
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + children_a_node - 1) / children_a_node);
    for (std::size_t child = 0; child < below.size(); ++child) {
      above[child / children_a_node].add(below[child]);
    }
    levels_.push_back(std::move(above));
  }
}

MeshPlace TriangleTree::nearest(Point2<double> at, std::span<const std::int32_t> regions, std::int32_t region) const {
  Search search{at, regions, region};
  if (!levels_.back().empty()) {
    look(search, levels_.size() - 1, 0);
  }
  return search.best;
}

void TriangleTree::look(Search& search, std::size_t level, std::size_t node) const {
  if (squared_distance(levels_[level][node], search.at) > search.squared_distance) {
    return;
  }
  if (level > 0) {
    const std::vector<Box>& boxes = levels_[level - 1];
    std::array<std::pair<double, std::size_t>, children_a_node> children{};
    const std::size_t first = node * children_a_node;
    const std::size_t count = std::min(children_a_node, boxes.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      children[i] = {squared_distance(boxes[first + i], search.at), first + i};
    }
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      look(search, level - 1, children[i].second);
    }
    return;
  }
  const std::size_t end = std::min((node + 1) * triangles_a_leaf, order_.size());
  for (std::size_t i = node * triangles_a_leaf; i < end; ++i) {
    const auto t = static_cast<std::size_t>(order_[i]);
    if (!search.regions.empty() && search.regions[t] != search.region) {
      continue;
    }
    const NearestPlace place = nearest_place(corners_of(points_, triangles_[t]), search.at);
    const bool is_lower = search.best.triangle < 0 || order_[i] < search.best.triangle;
    if (place.squared_distance < search.squared_distance ||
        (place.squared_distance == search.squared_distance && is_lower)) {
      search.squared_distance = place.squared_distance;
      search.best = {order_[i], place.weights};
    }
  }
}

}  // namespace trismooth
