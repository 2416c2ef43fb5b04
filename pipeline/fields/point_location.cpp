// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/point_location.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/fields/triangle_tree.h"

namespace trismooth {

namespace {

constexpr std::int64_t location_grain = 1024;

}  // namespace

/// From triangle to triangle towards a point, always across the side that the point is farthest beyond.
class PointLocation::Walk {
 public:
  Walk(const PointLocation& mesh, std::int32_t vertex, Point2<double> at) : mesh_(mesh), vertex_(vertex), at_(at) {}

  /// Where the point is, or nowhere.
  MeshPlace go() {
    std::int32_t triangle = start();
    for (int steps = 0; triangle >= 0 && steps < most_steps && scanned_ < most_scanned; ++steps) {
      const CornerAreas areas = mesh_.areas_at(triangle, at_);
      if (areas.hold_point()) {
        return {triangle, areas.weights()};
      }
      if (areas.total == 0) {
        return {};
      }
      const auto across = static_cast<std::size_t>(std::ranges::min_element(areas.areas) - areas.areas.begin());
      triangle = neighbour(triangle, across);
    }
    return {};
  }

 private:
  static constexpr int most_steps = 64;
  static constexpr std::size_t most_scanned = 2048;

  /// The triangle around the vertex that holds the point, or else the first that has it beyond the side across from the
  /// vertex.
  std::int32_t start() const {
    std::int32_t towards = -1;
    for (const std::int32_t t : mesh_.triangles_at(vertex_)) {
      const CornerAreas areas = mesh_.areas_at(t, at_);
      if (areas.hold_point()) {
        return t;
      }
      const auto own =
          static_cast<std::size_t>(std::ranges::find(mesh_.triangles_[t], vertex_) - mesh_.triangles_[t].begin());
      if (towards < 0 && areas.total > 0 && areas.areas[(own + 1) % 3] >= 0 && areas.areas[(own + 2) % 3] >= 0) {
        towards = t;
      }
    }
    return towards;
  }

  /// The triangle on the other side of the side across from a corner, or -1 where there is none, or several, or it is
  /// of another region.
  std::int32_t neighbour(std::int32_t triangle, std::size_t corner) {
    const Triangle& corners = mesh_.triangles_[triangle];
    std::int32_t one = corners[(corner + 1) % 3];
    std::int32_t other = corners[(corner + 2) % 3];
    if (mesh_.triangles_at(other).size() < mesh_.triangles_at(one).size()) {
      std::swap(one, other);
    }
    std::int32_t found = -1;
    for (const std::int32_t t : mesh_.triangles_at(one)) {
      ++scanned_;
      const Triangle& candidate = mesh_.triangles_[t];
      if (t == triangle || std::ranges::find(candidate, other) == candidate.end()) {
        continue;
      }
      if (found >= 0) {
        return -1;
      }
      found = t;
    }
    return found >= 0 && mesh_.region_of(found) == mesh_.region_of(triangle) ? found : -1;
  }

  const PointLocation& mesh_;
  std::int32_t vertex_;
  Point2<double> at_;
  std::size_t scanned_ = 0;
};

PointLocation::PointLocation(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                             std::span<const std::int32_t> regions)
    : points_(points),
      triangles_(triangles),
      regions_(regions),
      first_of_vertex_(points.size() + 2, 0),
      triangles_of_vertices_(3 * triangles.size()) {
  // Counted two places ahead: the sums are where each list begins, one place ahead, and filling the lists moves these
  // to their ends, which are where the next ones begin.
  for (const Triangle& triangle : triangles_) {
    for (const std::int32_t v : triangle) {
      ++first_of_vertex_[static_cast<std::size_t>(v) + 2];
    }
  }
  std::partial_sum(first_of_vertex_.begin(), first_of_vertex_.end(), first_of_vertex_.begin());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const std::int32_t v : triangles_[t]) {
      triangles_of_vertices_[first_of_vertex_[static_cast<std::size_t>(v) + 1]++] = static_cast<std::int32_t>(t);
    }
  }
}

std::span<const std::int32_t> PointLocation::triangles_at(std::int32_t vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return std::span(triangles_of_vertices_).subspan(first_of_vertex_[v], first_of_vertex_[v + 1] - first_of_vertex_[v]);
}

CornerAreas PointLocation::areas_at(std::int32_t triangle, Point2<double> at) const {
  const auto& [a, b, c] = triangles_[triangle];
  return corner_areas({points_[a], points_[b], points_[c]}, at);
}

std::int32_t PointLocation::region_of(std::int32_t triangle) const {
  return regions_.empty() ? 0 : regions_[triangle];
}

std::vector<MeshPlace> PointLocation::places_of(std::span<const std::int32_t> vertices,
                                                std::span<const Point2<double>> moved, Workers& workers) const {
  std::vector<MeshPlace> places(vertices.size());
  std::atomic<bool> is_complete{true};
  workers.for_blocks(std::ssize(vertices), location_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      places[i] = Walk(*this, vertices[i], moved[vertices[i]]).go();
      if (places[i].triangle < 0) {
        is_complete = false;
      }
    }
  });
  if (is_complete) {
    return places;
  }
  const TriangleTree tree(points_, triangles_);
  workers.for_blocks(std::ssize(vertices), location_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::span<const std::int32_t> around = triangles_at(vertices[i]);
      if (places[i].triangle >= 0 || around.empty()) {
        continue;
      }
      const Point2<double> at = moved[vertices[i]];
      places[i] = tree.nearest(at, regions_, region_of(around.front()));
    }
  });
  return places;
}

}  // namespace trismooth
