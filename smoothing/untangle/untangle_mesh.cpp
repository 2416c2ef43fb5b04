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

/// Per vertex of the rings that has one: 1 where its elements are of components that are turned over. All of them are,
/// then: those of a ring are of one component.
std::vector<std::uint8_t> vertices_of(const RingView& rings, const ElementList& elements,
                                      std::span<const std::uint8_t> of_elements) {
  std::int32_t last = -1;
  for (const std::span<const std::int32_t> corners : elements) {
    last = std::max(last, std::ranges::max(corners));
  }
  std::vector<std::uint8_t> of_input(static_cast<std::size_t>(last) + 1, 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (of_elements[e] != 0) {
      for (const std::int32_t v : elements[e]) {
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

/// The components of a mesh as the input orients it. Points are in the input's numbering.
class OrientedComponents {
 public:
  OrientedComponents(const ElementList& elements, std::span<const std::uint8_t> reversed, std::size_t vertex_count,
                     Workers& workers)
      : elements_(elements),
        reversed_(reversed),
        components_(elements.visit([&](const auto& listed) -> TriangleComponents {
          return match_sides(static_cast<std::int32_t>(vertex_count), listed, workers);
        })) {}

  /// Those of a negative area, which is not that of rounding.
  std::vector<std::uint8_t> of_negative_area(std::span<const Point2<double>> points) const {
    std::vector<std::vector<double>> areas(count());
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      areas[component(e)].push_back(
          measured(e, false, points, [](const auto& corners) { return doubled_area(corners); }));
    }
    std::vector<std::uint8_t> found(count(), 0);
    for (std::size_t c = 0; c < found.size(); ++c) {
      // In their own order: that in which elements are listed must not matter.
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
  /// `before`; and those in which most elements would be inverted, for then nobody would take them as turned. `nodes`:
  /// those that follow the vertices, or null.
  void take_out_worse(std::span<const Point2<double>> before, std::span<const Point2<double>> after,
                      const FollowingNodes* nodes, std::vector<std::uint8_t>& turned) const {
    std::vector<double> thresholds(count(), std::numeric_limits<double>::infinity());
    const auto for_turned = [&](const auto& visit) {
      for (std::size_t e = 0; e < elements_.size(); ++e) {
        if (turned[component(e)] != 0) {
          visit(e, component(e), quotient(e, false, before));
        }
      }
    };
    for_turned([&](std::size_t e, std::size_t c, double was) {
      const bool has_moved =
          std::ranges::any_of(elements_[e], [&](std::int32_t v) { return !(before[v] == after[v]); });
      if (has_moved && was < thresholds[c]) {
        thresholds[c] = was;
      }
    });
    std::vector<std::uint8_t> is_worse(count(), 0);
    std::vector<std::int64_t> balance(count(), 0);
    for_turned([&](std::size_t e, std::size_t c, double was) {
      const double is = quotient(e, true, after);
      balance[c] += (is > 0 ? 1 : 0) - (is < 0 ? 1 : 0);
      if (offends(was, is, thresholds[c]) || (nodes != nullptr && nodes->is_spoiled(elements_[e], true))) {
        is_worse[c] = 1;
      }
    });
    for (std::size_t c = 0; c < turned.size(); ++c) {
      if (is_worse[c] != 0 || balance[c] <= 0) {
        turned[c] = 0;
      }
    }
  }

  /// The elements of each component that are inverted or degenerate, where those of `turned` are turned over.
  std::vector<std::int64_t> inverted(std::span<const Point2<double>> points,
                                     std::span<const std::uint8_t> turned) const {
    std::vector<std::int64_t> found(count(), 0);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const std::size_t c = component(e);
      found[c] += quotient(e, turned[c] != 0, points) > 0 ? 0 : 1;
    }
    return found;
  }

  TurnedComponents elements_of(std::span<const std::uint8_t> turned) const {
    TurnedComponents found;
    found.count = static_cast<std::int32_t>(std::ranges::count(turned, std::uint8_t{1}));
    if (found.any()) {
      found.elements.resize(elements_.size());
      for (std::size_t e = 0; e < elements_.size(); ++e) {
        found.elements[e] = turned[component(e)];
      }
    }
    return found;
  }

  /// One byte a component, from one byte an element.
  std::vector<std::uint8_t> components_of(std::span<const std::uint8_t> of_elements) const {
    std::vector<std::uint8_t> found(count(), 0);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      found[component(e)] = of_elements[e];
    }
    return found;
  }

 private:
  std::size_t count() const { return static_cast<std::size_t>(components_.components); }
  std::size_t component(std::size_t e) const { return static_cast<std::size_t>(components_.component[e]); }

  /// measure(corners) of the points of an element. `is_turned`: it is turned over now.
  template <class Measure>
  double measured(std::size_t e, bool is_turned, std::span<const Point2<double>> points, const Measure& measure) const {
    return elements_.visit([&](const auto& listed) {
      return with_kind(canonical_corners(listed[e], (reversed_[e] != 0) != is_turned),
                       [&](const auto& corners) { return measure(points_of(corners, points)); });
    });
  }
  double quotient(std::size_t e, bool is_turned, std::span<const Point2<double>> points) const {
    return measured(e, is_turned, points, [](const auto& corners) { return shape_quotient(corners); });
  }

  ElementList elements_;
  std::span<const std::uint8_t> reversed_;
  TriangleComponents components_;
};

/// Rings of some vertices alone.
OneRings rings_of(const RingView& rings, std::span<const std::uint8_t> wanted) {
  OneRings found =
      OneRings::with_sizes(rings.size(), [&](std::int32_t v) { return wanted[v] != 0 ? std::ssize(rings[v]) : 0; });
  found.opposites.resize(rings.has_quadrilaterals() ? found.neighbours.size() : 0);
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (wanted[v] != 0) {
      std::ranges::copy(rings[v], found.neighbours.begin() + found.offsets[v]);
      if (rings.has_quadrilaterals()) {
        std::ranges::copy(rings.mixed(v).opposites, found.opposites.begin() + found.offsets[v]);
      }
    }
  }
  return found;
}

/// Untangles again, turned over, the components of a negative area. Keeps what is better.
TurnedComponents turn_over(const RingView& rings, const ElementList& elements, std::span<const std::uint8_t> reversed,
                           std::span<const Point2<double>> input, std::span<Point2<double>> points, Workers& workers) {
  const OrientedComponents components(elements, reversed, input.size(), workers);
  const std::vector<Point2<double>> before = in_input_order(rings, input);
  std::vector<std::uint8_t> turned = components.of_negative_area(before);
  const TurnedComponents tried = components.elements_of(turned);
  if (!tried.any()) {
    return {};
  }
  const OneRings tried_rings = rings_of(rings, vertices_of(rings, elements, tried.elements));
  const RingView view{tried_rings.offsets, tried_rings.neighbours, rings.input_index, tried_rings.opposites};
  std::vector<Point2<double>> found(input.begin(), input.end());
  untangle(turned_rings(view, elements, tried).of(view), found, workers);

  const std::vector<Point2<double>> after = in_input_order(rings, found);
  const std::vector<std::int64_t> as_listed =
      components.inverted(in_input_order(rings, points), std::vector<std::uint8_t>(turned.size(), 0));
  const std::vector<std::int64_t> as_turned = components.inverted(after, turned);
  for (std::size_t c = 0; c < turned.size(); ++c) {
    turned[c] = turned[c] != 0 && as_turned[c] < as_listed[c] ? 1 : 0;
  }
  components.take_out_worse(before, after, nullptr, turned);
  const TurnedComponents kept = components.elements_of(turned);
  if (kept.any()) {
    const std::vector<std::uint8_t> of_kept = vertices_of(rings, elements, kept.elements);
    for (std::int32_t v = 0; v < rings.size(); ++v) {
      points[v] = of_kept[v] != 0 ? found[v] : points[v];
    }
  }
  return kept;
}

}  // namespace

std::vector<std::uint8_t> turned_over(std::span<const std::uint8_t> reversed, const TurnedComponents& turned) {
  std::vector<std::uint8_t> now(reversed.begin(), reversed.end());
  for (std::size_t e = 0; e < turned.elements.size(); ++e) {
    now[e] ^= turned.elements[e];
  }
  return now;
}

TurnedRings turned_rings(const RingView& rings, const ElementList& elements, const TurnedComponents& turned) {
  TurnedRings found{{rings.neighbours.begin(), rings.neighbours.end()},
                    {rings.opposites.begin(), rings.opposites.end()}};
  const std::vector<std::uint8_t> is_turned = vertices_of(rings, elements, turned.elements);
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (is_turned[v] == 0) {
      continue;
    }
    std::reverse(found.neighbours.begin() + rings.offsets[v] + 1, found.neighbours.begin() + rings.offsets[v + 1]);
    if (rings.has_quadrilaterals()) {
      // Each is between a neighbour and the next one: the last was between the last one and the first.
      std::reverse(found.opposites.begin() + rings.offsets[v], found.opposites.begin() + rings.offsets[v + 1]);
    }
  }
  return found;
}

std::int64_t inverted_elements(const RingView& rings, const ElementList& elements, const TurnedComponents& turned,
                               std::span<const Point2<double>> points, Workers& workers) {
  return turned.any() ? inverted_elements(turned_rings(rings, elements, turned).of(rings), points, workers)
                      : inverted_elements(rings, points, workers);
}

MeshUntangling untangle_mesh(const RingView& rings, const ElementList& elements, std::span<const std::uint8_t> reversed,
                             std::span<Point2<double>> points, Workers& workers) {
  const std::vector<Point2<double>> input(points.begin(), points.end());
  const UntangleOutcome outcome = untangle(rings, points, workers);
  MeshUntangling result{outcome.inverted_before, outcome.inverted_after, {}};
  if (outcome.parts_of_no_area > 0 && !CallLimit::is_over()) {
    result.turned = turn_over(rings, elements, reversed, input, points, workers);
    result.inverted_after = inverted_elements(rings, elements, result.turned, points, workers);
  }
  return result;
}

GuardOutcome keep_never_worse(const RingView& rings, const ElementList& elements,
                              std::span<const std::uint8_t> reversed, TurnedComponents& turned,
                              std::span<const Point2<double>> before, std::span<Point2<double>> after, Workers& workers,
                              FollowingNodes* nodes) {
  if (!turned.any()) {
    return keep_never_worse(rings, before, after, workers, {}, nullptr, nodes);
  }
  const std::vector<std::uint8_t> were_turned = vertices_of(rings, elements, turned.elements);
  const OrientedComponents components(elements, reversed, before.size(), workers);
  std::vector<std::uint8_t> kept = components.components_of(turned.elements);
  components.take_out_worse(in_input_order(rings, before), in_input_order(rings, after), nodes, kept);
  turned = components.elements_of(kept);
  const std::vector<std::uint8_t> are_turned =
      turned.any() ? vertices_of(rings, elements, turned.elements) : std::vector<std::uint8_t>(were_turned.size(), 0);

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
