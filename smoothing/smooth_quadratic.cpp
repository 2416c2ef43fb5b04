// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/errors.h"
#include "trismooth/base/heights.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/commit.h"
#include "trismooth/smoothing/invalid_triangles.h"
#include "trismooth/smoothing/limited.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/smoothing/smooth.h"

namespace trismooth {

namespace {

constexpr std::size_t nodes_of_triangle = 6;

/// The elements by their corners, and the middles of those that have such.
struct ListedElements {
  OwnElements corners;
  std::vector<QuadraticElement> quadratics;
};

/// Looks at an element's vertices before they are taken, and from time to time at the limit.
void check_nodes(std::span<const std::int32_t> nodes, std::size_t element, std::int64_t vertex_count) {
  if (element % 16384 == 0) {
    CallLimit::look();
  }
  for (const std::int32_t v : nodes) {
    if (v < 0 || v >= vertex_count) {
      throw_no_such_vertex(static_cast<std::int64_t>(element), std::to_string(v), vertex_count);
    }
  }
}

ListedElements listed_triangles(std::span<const std::int32_t> nodes, std::int64_t vertex_count) {
  if (nodes.size() % nodes_of_triangle != 0) {
    throw std::invalid_argument("triangles: " + std::to_string(nodes.size()) +
                                " vertex numbers, expected six for each triangle");
  }
  const std::size_t count = nodes.size() / nodes_of_triangle;
  check_mesh_size(vertex_count, static_cast<std::int64_t>(count));
  ListedElements listed;
  std::vector<Triangle> corners;
  corners.reserve(count);
  listed.quadratics.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto of_triangle = nodes.subspan(nodes_of_triangle * t, nodes_of_triangle);
    check_nodes(of_triangle, t, vertex_count);
    corners.push_back({of_triangle[0], of_triangle[1], of_triangle[2]});
    listed.quadratics.push_back(
        {static_cast<std::int32_t>(t), {of_triangle[3], of_triangle[4], of_triangle[5], no_corner, no_corner}});
  }
  listed.corners = std::move(corners);
  return listed;
}

ListedElements listed_elements(std::span<const ElementNodes> elements, std::int64_t vertex_count) {
  check_mesh_size(vertex_count, std::ssize(elements));
  ListedElements listed;
  std::vector<MixedElement> all;
  all.reserve(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const ElementNodes& row = elements[e];
    const auto nodes = std::span(row).first(node_count(row));
    const std::size_t corners = corners_of_nodes(nodes.size());
    if (corners == 0 ||
        std::any_of(row.begin() + std::ssize(nodes), row.end(), [](auto v) { return v != no_corner; })) {
      throw MeshError(no_element_text(e, nodes.size()));
    }
    check_nodes(nodes, e, vertex_count);
    all.push_back({row[0], row[1], row[2], corners == 4 ? row[3] : no_corner});
    if (nodes.size() > corners) {
      QuadraticElement quadratic{static_cast<std::int32_t>(e), {}};
      quadratic.middles.fill(no_corner);
      std::ranges::copy(nodes.subspan(corners), quadratic.middles.begin());
      listed.quadratics.push_back(quadratic);
    }
  }
  listed.corners = std::move(all);
  return listed;
}

/// What the caller names, as flags; none where nothing is named.
std::vector<std::uint8_t> named_vertices(const Constraints& constraints, std::size_t vertex_count) {
  std::vector<std::uint8_t> named(constraints.fixed.begin(), constraints.fixed.end());
  if (!constraints.fixed_ids.empty()) {
    named.resize(vertex_count, 0);
  }
  for (const std::int32_t v : constraints.fixed_ids) {
    named[static_cast<std::size_t>(v)] = 1;
  }
  return named;
}

/// All nodes in the local frame of those that cells use.
LocalPoints local_nodes(std::span<const Point2<double>> nodes, const ElementList& elements,
                        std::span<const std::uint8_t> in_other_cell, Workers& workers) {
  std::vector<std::uint8_t> is_used(in_other_cell.begin(), in_other_cell.end());
  for (const auto corners : elements) {
    for (const std::int32_t v : corners) {
      is_used[static_cast<std::size_t>(v)] = 1;
    }
  }
  return local_points(
      nodes, [&](std::size_t v) { return is_used[v] != 0; }, workers);
}

SmoothingResult smooth_nodes(const PointView& points, const ListedElements& listed, const Constraints& constraints,
                             const SmoothingOptions& options) {
  Workers workers(options.threads);
  const ElementList elements = listed.corners.list();
  check_constraints(constraints, static_cast<std::int32_t>(points.size()), static_cast<std::int64_t>(elements.size()));
  if (constraints.slide.along != Slide::off) {
    throw std::invalid_argument(
        "vertices of quadratic elements do not slide, since the middles of sides would leave them");
  }
  std::vector<std::uint8_t> named = named_vertices(constraints, points.size());
  std::vector<std::uint8_t> in_other_cell(constraints.other_cells.begin(), constraints.other_cells.end());
  in_other_cell.resize(points.size(), 0);
  auto [middles, shared_middles] = settle_middles(elements, listed.quadratics, named, in_other_cell);
  Constraints settled;
  settled.fixed = named;
  settled.other_cells = in_other_cell;
  settled.regions = constraints.regions;
  settled.slide = constraints.slide;
  std::vector<Point2<double>> nodes = points.read(workers);
  find_shares(middles, [&nodes](std::int32_t vertex) {
    const Point2<double> p = nodes[static_cast<std::size_t>(vertex)];
    return std::array<double, 3>{p.x, p.y, 0};
  });
  SmoothingOptions of_sweeps = options;
  // What has been untangled needs the guard that knows what the sweeps began with, too.
  of_sweeps.guard = options.guard && options.untangles();
  SmoothingPlan of_corners(std::ssize(nodes), IndexView(elements), settled, of_sweeps);
  if (points.components() == 3) {
    require_one_height(points, nodes, [&of_corners] { return of_corners.fixed(); });
  }
  if (CallLimit* const limit = CallLimit::current()) {
    limit->keep_back(limit->seconds());  // what comes behind the sweeps finds all that once more, and commits
  }
  std::vector<Point2<double>> swept = nodes;
  SmoothingResult result = of_corners.smooth(swept, points.storage());
  result.shared_middles = shared_middles;
  const LocalPoints before = local_nodes(nodes, elements, in_other_cell, workers);
  const MeshRings rings = find_mesh_rings(before.points, elements, settled, workers);
  std::vector<double> stored = numbers_of(nodes);
  commit({rings, elements, listed.quadratics, middles, before, swept}, plane_image(points.storage()), stored, nodes,
         options, workers, result);
  elements.visit([&](const auto& all) {
    count_invalid(
        all, rings.reversed, [&](std::int32_t v) { return before.frame.enter(nodes[v]); }, workers, result);
  });
  points.write(nodes, workers);
  return result;
}

}  // namespace

SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const Constraints& constraints, const SmoothingOptions& options) {
  options.validate();
  return limited(options, backend_of(options).name(), [&] {
    return smooth_nodes(points, listed_triangles(triangles, static_cast<std::int64_t>(points.size())), constraints,
                        options);
  });
}

SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const SmoothingOptions& options) {
  return smooth_quadratic(points, triangles, Constraints{}, options);
}

SmoothingResult smooth_quadratic(const PointView& points, std::span<const ElementNodes> elements,
                                 const Constraints& constraints, const SmoothingOptions& options) {
  options.validate();
  return limited(options, backend_of(options).name(), [&] {
    return smooth_nodes(points, listed_elements(elements, static_cast<std::int64_t>(points.size())), constraints,
                        options);
  });
}

}  // namespace trismooth
