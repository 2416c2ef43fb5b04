// SPDX-License-Identifier: BSD-3-Clause
#include "smoothing_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "broken.h"
#include "support/naive_smoothing.h"

namespace fuzz {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;
using TrianglesOfEdges = std::map<Edge, std::vector<std::size_t>>;

Edge edge(const Triangle& triangle, int i) {
  return std::minmax(triangle[i], triangle[(i + 1) % 3]);
}

bool runs_along(const Triangle& triangle, Edge edge) {
  for (int i = 0; i < 3; ++i) {
    if (triangle[i] == edge.first && triangle[(i + 1) % 3] == edge.second) {
      return true;
    }
  }
  return false;
}

/// In the frame of those of `frame_of` that are used.
std::vector<Point2<double>> in_local_frame(std::span<const Point2<double>> frame_of, std::span<const std::uint8_t> used,
                                           std::span<const Point2<double>> points) {
  const trismooth::LocalFrame frame = frame_of_used(frame_of, used);
  std::vector<Point2<double>> local(points.size());
  std::ranges::transform(points, local.begin(), [&](Point2<double> p) { return frame.enter(p); });
  return local;
}

Triangle counter_clockwise(const Triangle& triangle, std::uint8_t reversed) {
  return reversed != 0 ? Triangle{triangle[0], triangle[2], triangle[1]} : triangle;
}

/// The representative of `element` in a forest of parents.
std::size_t root_of(std::vector<std::size_t>& parents, std::size_t element) {
  while (parents[element] != element) {
    element = parents[element] = parents[parents[element]];
  }
  return element;
}

/// Vertices whose triangles are not all connected by edges that end in it.
void fix_bow_ties(std::span<const Triangle> triangles, const TrianglesOfEdges& edges,
                  std::vector<std::uint8_t>& fixed) {
  // A node for every corner; an edge with two triangles joins the corners on its either side.
  std::vector<std::size_t> parents(3 * triangles.size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    parents[i] = i;
  }
  const auto corner = [&](std::size_t t, std::int32_t vertex) {
    return 3 * t + static_cast<std::size_t>(std::ranges::find(triangles[t], vertex) - triangles[t].begin());
  };
  for (const auto& [ends, both] : edges) {
    if (both.size() == 2) {
      for (const std::int32_t vertex : {ends.first, ends.second}) {
        parents[root_of(parents, corner(both[0], vertex))] = root_of(parents, corner(both[1], vertex));
      }
    }
  }
  std::vector<std::size_t> fan(fixed.size(), parents.size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(triangles[i / 3][i % 3]);
    const std::size_t root = root_of(parents, i);
    if (fan[vertex] != parents.size() && fan[vertex] != root) {
      fixed[vertex] = 1;
    }
    fan[vertex] = root;
  }
}

/// Turns the triangles of the component of `first` one way, then that way which most of them have.
void orient_component(std::size_t first, std::span<const Point2<double>> local, std::span<const Triangle> triangles,
                      const TrianglesOfEdges& edges, std::vector<std::uint8_t>& seen, NaiveTopology& topology) {
  std::vector<std::size_t> component{first};
  seen[first] = 1;
  for (std::size_t i = 0; i < component.size(); ++i) {
    const std::size_t t = component[i];
    for (int side = 0; side < 3; ++side) {
      const Edge across = edge(triangles[t], side);
      const auto& both = edges.at(across);
      if (both.size() != 2) {
        continue;
      }
      const std::size_t other = both[0] == t ? both[1] : both[0];
      const bool same_way = runs_along(triangles[t], across) != runs_along(triangles[other], across);
      const auto expected = static_cast<std::uint8_t>(topology.reversed[t] ^ (same_way ? 0 : 1));
      if (seen[other] == 0) {
        seen[other] = 1;
        topology.reversed[other] = expected;
        component.push_back(other);
      } else if (topology.reversed[other] != expected) {
        topology.orientable = false;
      }
    }
  }
  std::ranges::sort(component);
  std::int64_t balance = 0;
  std::int64_t first_sign = 0;
  for (const std::size_t t : component) {
    const double quotient = naive::element_quotient(local, counter_clockwise(triangles[t], topology.reversed[t]));
    const int sign = (quotient > 0) - (quotient < 0);
    balance += sign;
    first_sign = first_sign == 0 ? sign : first_sign;
  }
  if (balance < 0 || (balance == 0 && first_sign < 0)) {
    for (const std::size_t t : component) {
      topology.reversed[t] ^= 1;
    }
  }
}

}  // namespace

trismooth::LocalFrame frame_of_used(std::span<const Point2<double>> points, std::span<const std::uint8_t> used) {
  std::vector<Point2<double>> counted;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (used[v] != 0) {
      counted.push_back(points[v]);
    }
  }
  return trismooth::local_frame(counted);
}

bool same_bits(Point2<double> a, Point2<double> b) {
  return std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
         std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y);
}

NaiveTopology naive_topology(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                             const trismooth::Constraints& constraints) {
  TrianglesOfEdges edges;
  NaiveTopology topology;
  topology.fixed.assign(points.size(), 1);
  topology.used.assign(points.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      edges[edge(triangles[t], i)].push_back(t);
      topology.fixed[static_cast<std::size_t>(triangles[t][i])] = 0;
      topology.used[static_cast<std::size_t>(triangles[t][i])] = 1;
    }
  }
  for (auto& [ends, sides] : edges) {
    // Two triangles of the same corners are not beside each other.
    if (sides.size() == 2 && std::ranges::is_permutation(triangles[sides[0]], triangles[sides[1]])) {
      sides.clear();
    }
  }
  for (const auto& [ends, sides] : edges) {
    const bool between_regions = !constraints.regions.empty() && sides.size() == 2 &&
                                 constraints.regions[sides[0]] != constraints.regions[sides[1]];
    if (sides.size() != 2 || between_regions) {
      topology.fixed[static_cast<std::size_t>(ends.first)] = 1;
      topology.fixed[static_cast<std::size_t>(ends.second)] = 1;
    }
  }
  fix_bow_ties(triangles, edges, topology.fixed);
  for (const std::span<const std::uint8_t> flags : {constraints.fixed, constraints.other_cells}) {
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (flags[v] != 0) {
        topology.fixed[v] = 1;
      }
    }
  }
  for (const std::int32_t vertex : constraints.fixed_ids) {
    topology.fixed[static_cast<std::size_t>(vertex)] = 1;
  }

  for (std::size_t v = 0; v < constraints.other_cells.size(); ++v) {
    topology.used[v] |= constraints.other_cells[v] != 0 ? std::uint8_t{1} : std::uint8_t{0};
  }

  const std::vector<Point2<double>> local = in_local_frame(points, topology.used, points);
  topology.reversed.assign(triangles.size(), 0);
  std::vector<std::uint8_t> seen(triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (seen[t] == 0) {
      orient_component(t, local, triangles, edges, seen, topology);
    }
  }
  return topology;
}

void require_never_worse(const Smoothing& smoothing) {
  const std::span<const Triangle> triangles = smoothing.triangles;
  const NaiveTopology& topology = smoothing.topology;
  const std::span<const Point2<double>> before = smoothing.before;
  const std::span<const Point2<double>> after = smoothing.after;
  const trismooth::SmoothingResult& result = smoothing.result;
  std::int64_t moved = 0;
  std::int64_t free = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    require(std::isfinite(after[v].x) && std::isfinite(after[v].y),
            "vertex " + std::to_string(v) + " is not finite after smoothing");
    const bool is_fixed = topology.fixed[v] != 0;
    free += is_fixed ? 0 : 1;
    moved += same_bits(before[v], after[v]) ? 0 : 1;
    require(!is_fixed || same_bits(before[v], after[v]), "fixed vertex " + std::to_string(v) + " moved");
  }
  if (result.inverted < 0) {
    // The time was up before anything was found out.
    require(smoothing.options.time_limit_seconds < std::numeric_limits<double>::infinity(), "has not looked at all");
    require(result.stop_reason == trismooth::StopReason::time_limit && result.sweeps == 0 && moved == 0 &&
                result.moved_vertices == 0 && result.reverted.empty(),
            "says more than it has found out");
    return;
  }
  require(result.free_vertices == free,
          "says " + std::to_string(result.free_vertices) + " vertices are free, found " + std::to_string(free));
  require(result.moved_vertices == moved,
          "says " + std::to_string(result.moved_vertices) + " vertices moved, found " + std::to_string(moved));
  require(result.reverted_vertices == static_cast<std::int64_t>(result.reverted.size()), "miscounts reverted vertices");
  require(result.sweeps == static_cast<std::int64_t>(result.history.size()), "history is not that of all sweeps");
  const std::optional<trismooth::UntanglingResult>& untangling = result.untangling;
  for (const auto& [vertex, position] : result.reverted) {
    const Point2<double> now = after[static_cast<std::size_t>(vertex)];
    const bool is_untangled = untangling && untangling->inverted_before > 0;  // then it may be back from the sweeps
    require(same_bits(before[static_cast<std::size_t>(vertex)], now) || (is_untangled && !(now == position)),
            "vertex " + std::to_string(vertex) + " went back to where it was not");
  }
  if (!smoothing.options.guard) {
    require(result.reverted.empty(), "took vertices back without being asked to");
    return;
  }

  const std::vector<Point2<double>> local_before = in_local_frame(before, topology.used, before);
  const std::vector<Point2<double>> local_after = in_local_frame(before, topology.used, after);
  const auto has_moved = [&](std::int32_t v) {
    return !same_bits(before[static_cast<std::size_t>(v)], after[static_cast<std::size_t>(v)]);
  };
  const auto quotients = [&](std::size_t t) {
    const bool is_turned = untangling && !untangling->turned.empty() && untangling->turned[t] != 0;
    const auto reversed = static_cast<std::uint8_t>(topology.reversed[t] ^ (is_turned ? 1 : 0));
    return std::pair(naive::element_quotient(local_before, counter_clockwise(triangles[t], topology.reversed[t])),
                     naive::element_quotient(local_after, counter_clockwise(triangles[t], reversed)));
  };
  double threshold = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (std::ranges::any_of(triangles[t], has_moved)) {
      threshold = std::min(threshold, quotients(t).first);
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [was, is] = quotients(t);
    require(!std::isnan(is), "triangle " + std::to_string(t) + " has no quality");
    require(!naive::offends(was, is, threshold), "triangle " + std::to_string(t) +
                                                     " was made worse: its quotient was " + std::to_string(was) +
                                                     ", is " + std::to_string(is));
  }
}

}  // namespace fuzz
