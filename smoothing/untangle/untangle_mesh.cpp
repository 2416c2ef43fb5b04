#include "trismooth/smoothing/untangle/untangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"

namespace trismooth {

namespace {

/// The components of the mesh, of vertices in the input's numbering.
class TurnedMesh {
 public:
  TurnedMesh(const RingView& rings, std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
             std::span<const Point2<double>> points, Workers& workers)
      : rings_(rings), triangles_(triangles), reversed_(reversed.begin(), reversed.end()) {
    const std::vector<Point2<double>> input = in_input_order(points);
    sides_ = match_sides(static_cast<std::int32_t>(points.size()), triangles, workers);
    struct Area {
      double sum = 0;
      double size = 0;  ///< without the signs

      bool is_negative() const { return sum < -no_area * size; }
    };
    std::vector<Area> areas(static_cast<std::size_t>(sides_.components));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [a, b, c] = triangles[t];
      const double area = cross(input[b] - input[a], input[c] - input[a]);
      areas[sides_.component[t]].sum += reversed_[t] != 0 ? -area : area;
      areas[sides_.component[t]].size += std::abs(area);
    }
    std::vector<std::uint8_t> turned_vertices(points.size(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (areas[sides_.component[t]].is_negative()) {
        reversed_[t] ^= 1U;
        for (const std::int32_t v : triangles[t]) {
          turned_vertices[v] = 1;
        }
      }
    }
    count_ = static_cast<std::int32_t>(std::ranges::count_if(areas, &Area::is_negative));
    turned_.resize(points.size());
    for (std::int32_t v = 0; v < rings_.size(); ++v) {
      turned_[v] = rings_.is_free(v) ? turned_vertices[rings_.input(v)] : std::uint8_t{0};
    }
  }

  std::int32_t count() const { return count_; }
  const std::vector<std::uint8_t>& turned() const { return turned_; }
  const std::vector<std::uint8_t>& reversed() const { return reversed_; }

  /// Whether the majority of every component is positive as it has been turned.
  bool is_confirmed_by(std::span<const Point2<double>> points) const {
    return orient(sides_, triangles_, in_input_order(points)).reversed == reversed_;
  }

 private:
  std::vector<Point2<double>> in_input_order(std::span<const Point2<double>> points) const {
    std::vector<Point2<double>> ordered(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
      ordered[rings_.input(static_cast<std::int32_t>(v))] = points[v];
    }
    return ordered;
  }

  const RingView& rings_;
  std::span<const Triangle> triangles_;
  std::vector<std::uint8_t> reversed_;
  MatchedSides sides_;
  std::int32_t count_ = 0;
  std::vector<std::uint8_t> turned_;
};

}  // namespace

void turn_rings(std::span<const std::int64_t> offsets, std::span<const std::uint8_t> turned,
                std::span<std::int32_t> neighbours) {
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    if (turned[v] != 0 && offsets[v] != offsets[v + 1]) {
      std::reverse(neighbours.begin() + offsets[v] + 1, neighbours.begin() + offsets[v + 1]);
    }
  }
}

MeshUntangling untangle_mesh(const RingView& rings, std::span<const Triangle> triangles,
                             std::span<const std::uint8_t> reversed, std::span<Point2<double>> points,
                             Workers& workers) {
  MeshUntangling result;
  std::vector<Point2<double>> as_listed(points.begin(), points.end());
  result.outcome = untangle(rings, as_listed, workers);
  if (result.outcome.parts_of_no_area > 0) {
    const TurnedMesh mesh(rings, triangles, reversed, points, workers);
    if (mesh.count() > 0) {
      std::vector<std::int32_t> neighbours(rings.neighbours.begin(), rings.neighbours.end());
      turn_rings(rings.offsets, mesh.turned(), neighbours);
      std::vector<Point2<double>> turned(points.begin(), points.end());
      UntangleOutcome outcome = untangle({rings.offsets, neighbours, rings.input_index}, turned, workers);
      if (outcome.inverted_after < result.outcome.inverted_after && mesh.is_confirmed_by(turned)) {
        outcome.inverted_before = result.outcome.inverted_before;
        result = {outcome, mesh.count(), mesh.turned(), mesh.reversed()};
        as_listed = std::move(turned);
      }
    }
  }
  std::ranges::copy(as_listed, points.begin());
  return result;
}

}  // namespace trismooth
