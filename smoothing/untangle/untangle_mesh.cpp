// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/untangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/element.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/untangle/untangle.h"

namespace trismooth {

namespace {

std::vector<Point2<double>> in_input_order(const RingView& rings, std::span<const Point2<double>> points) {
  std::vector<Point2<double>> ordered(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    ordered[rings.input(static_cast<std::int32_t>(v))] = points[v];
  }
  return ordered;
}

/// Per vertex of the rings that has one: 1 where its triangles are of components that are turned over. All of them are,
/// then: those of a ring are of one component.
std::vector<std::uint8_t> vertices_of(const RingView& rings, std::span<const Triangle> triangles,
                                      std::span<const std::uint8_t> of_triangles) {
  std::int32_t last = -1;
  for (const Triangle& triangle : triangles) {
    last = std::max({last, triangle[0], triangle[1], triangle[2]});
  }
  std::vector<std::uint8_t> of_input(static_cast<std::size_t>(last) + 1, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (of_triangles[t] != 0) {
      for (const std::int32_t v : triangles[t]) {
        of_input[v] = 1;
      }
    }
  }
  std::vector<std::uint8_t> found(static_cast<std::size_t>(rings.size()), 0);
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    found[v] = rings.is_free(v) ? of_input[rings.input(v)] : std::uint8_t{0};
  }
  return found;
}

double quotient(const Triangle& triangle, bool is_reversed, std::span<const Point2<double>> points) {
  return shape_quotient(points_of(canonical_corners(triangle, is_reversed), points));
}

/// The components of a mesh as the input orients it. Points are in the input's numbering.
class OrientedComponents {
 public:
  OrientedComponents(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                     std::size_t vertex_count, Workers& workers)
      : triangles_(triangles),
        reversed_(reversed),
        components_(match_sides(static_cast<std::int32_t>(vertex_count), triangles, workers)) {}

  /// Those of a negative area, which is not that of rounding.
  std::vector<std::uint8_t> of_negative_area(std::span<const Point2<double>> points) const {
    std::vector<std::vector<double>> areas(count());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Triangle corners = canonical_corners(triangles_[t], reversed_[t] != 0);
      areas[component(t)].push_back(doubled_area(points_of(corners, points)));
    }
    std::vector<std::uint8_t> found(count(), 0);
    for (std::size_t c = 0; c < found.size(); ++c) {
      // In their own order: that in which triangles are listed must not matter.
      std::ranges::sort(areas[c]);
      double sum = 0;
      double size = 0;
      for (const double area : areas[c]) {
        sum += area;
        size += std::abs(area);
      }
      found[c] = sum < -no_area * size ? 1 : 0;
    }
    return found;
  }

  /// Takes out of `turned`, one byte a component, those that are worse at `after`, turned over, than they were at
  /// `before`; and those in which most triangles would be inverted, for then nobody would take them as turned. `nodes`:
  /// those that follow the vertices, or null.
  void take_out_worse(std::span<const Point2<double>> before, std::span<const Point2<double>> after,
                      const FollowingNodes* nodes, std::vector<std::uint8_t>& turned) const {
    std::vector<double> thresholds(count(), std::numeric_limits<double>::infinity());
    const auto for_turned = [&](const auto& visit) {
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (turned[component(t)] != 0) {
          visit(t, component(t), quotient(triangles_[t], reversed_[t] != 0, before));
        }
      }
    };
    for_turned([&](std::size_t t, std::size_t c, double was) {
      const bool has_moved =
          std::ranges::any_of(triangles_[t], [&](std::int32_t v) { return !(before[v] == after[v]); });
      if (has_moved && was < thresholds[c]) {
        thresholds[c] = was;
      }
    });
    std::vector<std::uint8_t> is_worse(count(), 0);
    std::vector<std::int64_t> balance(count(), 0);
    for_turned([&](std::size_t t, std::size_t c, double was) {
      const double is = quotient(triangles_[t], reversed_[t] == 0, after);
      balance[c] += (is > 0 ? 1 : 0) - (is < 0 ? 1 : 0);
      if (offends(was, is, thresholds[c]) || (nodes != nullptr && nodes->is_spoiled(triangles_[t], true))) {
        is_worse[c] = 1;
      }
    });
    for (std::size_t c = 0; c < turned.size(); ++c) {
      if (is_worse[c] != 0 || balance[c] <= 0) {
        turned[c] = 0;
      }
    }
  }

  /// The triangles of each component that are inverted or degenerate, where those of `turned` are turned over.
  std::vector<std::int64_t> inverted(std::span<const Point2<double>> points,
                                     std::span<const std::uint8_t> turned) const {
    std::vector<std::int64_t> found(count(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const std::size_t c = component(t);
      found[c] += quotient(triangles_[t], (reversed_[t] != 0) != (turned[c] != 0), points) > 0 ? 0 : 1;
    }
    return found;
  }

  TurnedComponents triangles_of(std::span<const std::uint8_t> turned) const {
    TurnedComponents found;
    found.count = static_cast<std::int32_t>(std::ranges::count(turned, std::uint8_t{1}));
    if (found.any()) {
      found.triangles.resize(triangles_.size());
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        found.triangles[t] = turned[component(t)];
      }
    }
    return found;
  }

  /// One byte a component, from one byte a triangle.
  std::vector<std::uint8_t> components_of(std::span<const std::uint8_t> of_triangles) const {
    std::vector<std::uint8_t> found(count(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      found[component(t)] = of_triangles[t];
    }
    return found;
  }

 private:
  std::size_t count() const { return static_cast<std::size_t>(components_.components); }
  std::size_t component(std::size_t t) const { return static_cast<std::size_t>(components_.component[t]); }

  std::span<const Triangle> triangles_;
  std::span<const std::uint8_t> reversed_;
  TriangleComponents components_;
};

/// Rings of some vertices alone.
OneRings rings_of(const RingView& rings, std::span<const std::uint8_t> wanted) {
  OneRings found =
      OneRings::with_sizes(rings.size(), [&](std::int32_t v) { return wanted[v] != 0 ? std::ssize(rings[v]) : 0; });
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (wanted[v] != 0) {
      std::ranges::copy(rings[v], found.neighbours.begin() + found.offsets[v]);
    }
  }
  return found;
}

/// Untangles again, turned over, the components of a negative area. Keeps what is better.
TurnedComponents turn_over(const RingView& rings, std::span<const Triangle> triangles,
                           std::span<const std::uint8_t> reversed, std::span<const Point2<double>> input,
                           std::span<Point2<double>> points, Workers& workers) {
  const OrientedComponents components(triangles, reversed, input.size(), workers);
  const std::vector<Point2<double>> before = in_input_order(rings, input);
  std::vector<std::uint8_t> turned = components.of_negative_area(before);
  const TurnedComponents tried = components.triangles_of(turned);
  if (!tried.any()) {
    return {};
  }
  OneRings tried_rings = rings_of(rings, vertices_of(rings, triangles, tried.triangles));
  const RingView view{tried_rings.offsets, tried_rings.neighbours, rings.input_index};
  tried_rings.neighbours = turned_neighbours(view, triangles, tried);
  std::vector<Point2<double>> found(input.begin(), input.end());
  untangle({tried_rings.offsets, tried_rings.neighbours, rings.input_index}, found, workers);

  const std::vector<Point2<double>> after = in_input_order(rings, found);
  const std::vector<std::int64_t> as_listed =
      components.inverted(in_input_order(rings, points), std::vector<std::uint8_t>(turned.size(), 0));
  const std::vector<std::int64_t> as_turned = components.inverted(after, turned);
  for (std::size_t c = 0; c < turned.size(); ++c) {
    turned[c] = turned[c] != 0 && as_turned[c] < as_listed[c] ? 1 : 0;
  }
  components.take_out_worse(before, after, nullptr, turned);
  const TurnedComponents kept = components.triangles_of(turned);
  if (kept.any()) {
    const std::vector<std::uint8_t> of_kept = vertices_of(rings, triangles, kept.triangles);
    for (std::int32_t v = 0; v < rings.size(); ++v) {
      points[v] = of_kept[v] != 0 ? found[v] : points[v];
    }
  }
  return kept;
}

}  // namespace

std::vector<std::uint8_t> turned_over(std::span<const std::uint8_t> reversed, const TurnedComponents& turned) {
  std::vector<std::uint8_t> now(reversed.begin(), reversed.end());
  for (std::size_t t = 0; t < turned.triangles.size(); ++t) {
    now[t] ^= turned.triangles[t];
  }
  return now;
}

BulkVector<std::int32_t> turned_neighbours(const RingView& rings, std::span<const Triangle> triangles,
                                           const TurnedComponents& turned) {
  BulkVector<std::int32_t> neighbours(rings.neighbours.begin(), rings.neighbours.end());
  const std::vector<std::uint8_t> is_turned = vertices_of(rings, triangles, turned.triangles);
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (is_turned[v] != 0) {
      std::reverse(neighbours.begin() + rings.offsets[v] + 1, neighbours.begin() + rings.offsets[v + 1]);
    }
  }
  return neighbours;
}

std::int64_t inverted_triangles(const RingView& rings, std::span<const Triangle> triangles,
                                const TurnedComponents& turned, std::span<const Point2<double>> points,
                                Workers& workers) {
  if (!turned.any()) {
    return inverted_triangles(rings, points, workers);
  }
  const BulkVector<std::int32_t> neighbours = turned_neighbours(rings, triangles, turned);
  return inverted_triangles({rings.offsets, neighbours, rings.input_index}, points, workers);
}

MeshUntangling untangle_mesh(const RingView& rings, std::span<const Triangle> triangles,
                             std::span<const std::uint8_t> reversed, std::span<Point2<double>> points,
                             Workers& workers) {
  const std::vector<Point2<double>> input(points.begin(), points.end());
  const UntangleOutcome outcome = untangle(rings, points, workers);
  MeshUntangling result{outcome.inverted_before, outcome.inverted_after, {}};
  if (outcome.parts_of_no_area > 0 && !CallLimit::is_over()) {
    result.turned = turn_over(rings, triangles, reversed, input, points, workers);
    result.inverted_after = inverted_triangles(rings, triangles, result.turned, points, workers);
  }
  return result;
}

GuardOutcome keep_never_worse(const RingView& rings, std::span<const Triangle> triangles,
                              std::span<const std::uint8_t> reversed, TurnedComponents& turned,
                              std::span<const Point2<double>> before, std::span<Point2<double>> after, Workers& workers,
                              FollowingNodes* nodes) {
  if (!turned.any()) {
    return keep_never_worse(rings, before, after, workers, {}, nullptr, nodes);
  }
  const std::vector<std::uint8_t> were_turned = vertices_of(rings, triangles, turned.triangles);
  const OrientedComponents components(triangles, reversed, before.size(), workers);
  std::vector<std::uint8_t> kept = components.components_of(turned.triangles);
  components.take_out_worse(in_input_order(rings, before), in_input_order(rings, after), nodes, kept);
  turned = components.triangles_of(kept);
  const std::vector<std::uint8_t> are_turned =
      turned.any() ? vertices_of(rings, triangles, turned.triangles) : std::vector<std::uint8_t>(were_turned.size(), 0);

  std::vector<Point2<double>> rest(after.begin(), after.end());
  std::vector<std::int32_t> back;
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (were_turned[v] != 0) {
      rest[v] = before[v];
      if (are_turned[v] == 0 && !(after[v] == before[v])) {
        back.push_back(v);
        if (nodes != nullptr) {
          nodes->follow(v);
        }
      }
    }
  }
  GuardOutcome outcome = keep_never_worse(rings, before, rest, workers, {}, nullptr, nodes);
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    after[v] = are_turned[v] != 0 ? after[v] : rest[v];
  }
  outcome.rounds += back.empty() ? 0 : 1;
  std::vector<std::int32_t> reverted;
  std::ranges::merge(outcome.reverted, back, std::back_inserter(reverted));
  outcome.reverted = std::move(reverted);
  return outcome;
}

}  // namespace trismooth
