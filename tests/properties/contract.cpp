// SPDX-License-Identifier: BSD-3-Clause
#include "properties/contract.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace properties {

namespace {

using trismooth::Triangle;

/// The coordinates in units of a power of two in which no square overflows and none that matters underflows.
class Units {
 public:
  explicit Units(std::span<const double> xy) {
    double low[2]{};
    double high[2]{};
    for (std::size_t i = 0; i < xy.size(); ++i) {
      low[i % 2] = i < 2 ? xy[i] : std::min(low[i % 2], xy[i]);
      high[i % 2] = i < 2 ? xy[i] : std::max(high[i % 2], xy[i]);
    }
    const double extent = xy.empty() ? 0 : std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);
    std::frexp(extent, &exponent_);
  }
  template <class T>
  Point2<T> operator()(std::span<const double> xy, std::int32_t v) const {
    return {std::ldexp(T(xy[2 * v]), -exponent_), std::ldexp(T(xy[2 * v + 1]), -exponent_)};
  }

 private:
  int exponent_ = 0;
};

/// alpha without 2 sqrt(3), as section 1 of the design writes it.
template <class T>
T alpha(Point2<T> a, Point2<T> b, Point2<T> c) {
  const auto minus = [](Point2<T> p, Point2<T> q) { return Point2<T>{p.x - q.x, p.y - q.y}; };
  const auto squared = [](Point2<T> p) { return p.x * p.x + p.y * p.y; };
  const Point2<T> ab = minus(b, a);
  const Point2<T> ac = minus(c, a);
  const T denominator = squared(ab) + squared(minus(c, b)) + squared(ac);
  return denominator == 0 ? T(0) : (ab.x * ac.y - ab.y * ac.x) / denominator;
}

template <class T>
T alpha(const Units& units, std::span<const double> xy, const Triangle& t) {
  return alpha(units.operator()<T>(xy, t[0]), units.operator()<T>(xy, t[1]), units.operator()<T>(xy, t[2]));
}

Triangle from_smallest(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Triangles around edges.
class Edges {
 public:
  explicit Edges(std::vector<Triangle>& triangles) : triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        around_[std::minmax({triangles[t][i], triangles[t][(i + 1) % 3]})].push_back(t);
      }
    }
  }

  const std::map<Edge, std::vector<std::size_t>>& all() const { return around_; }

  /// Whether the triangles on an edge are two beside each other, and not one upon the other.
  bool are_neighbours(const std::vector<std::size_t>& sharing) const {
    return sharing.size() == 2 && !std::ranges::is_permutation(triangles_[sharing[0]], triangles_[sharing[1]]);
  }

  /// Lists all triangles of a component in one direction, that of its first one, and answers them.
  std::set<std::size_t> list_alike(std::size_t start) {
    std::set<std::size_t> component{start};
    std::vector<std::size_t> reached{start};
    while (!reached.empty()) {
      const Triangle t = triangles_[reached.back()];
      const std::size_t index = reached.back();
      reached.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t from = t[i];
        const std::int32_t to = t[(i + 1) % 3];
        const auto& sharing = around_.at(std::minmax({from, to}));
        if (!are_neighbours(sharing)) {
          continue;
        }
        const std::size_t other = sharing[0] == index ? sharing[1] : sharing[0];
        if (component.insert(other).second) {
          Triangle& u = triangles_[other];
          for (std::size_t j = 0; j < 3; ++j) {
            if (u[j] == from && u[(j + 1) % 3] == to) {
              std::swap(u[0], u[1]);
              break;
            }
          }
          reached.push_back(other);
        }
      }
    }
    return component;
  }

 private:
  std::vector<Triangle>& triangles_;
  std::map<Edge, std::vector<std::size_t>> around_;
};

void hold_what_the_mesh_holds(const RandomMesh& mesh, const Edges& edges, std::vector<bool>& fixed) {
  std::vector<std::set<std::size_t>> triangles_at(fixed.size());
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.mesh.triangles[t]) {
      triangles_at[v].insert(t);
    }
  }
  std::vector<std::map<std::size_t, std::vector<std::size_t>>> next_at(fixed.size());
  for (const auto& [edge, sharing] : edges.all()) {
    const bool joins = edges.are_neighbours(sharing);
    const bool between_regions = joins && !mesh.regions.empty() && mesh.regions[sharing[0]] != mesh.regions[sharing[1]];
    for (const std::int32_t v : {edge.first, edge.second}) {
      fixed[v] = fixed[v] || !joins || between_regions;
      if (joins) {
        next_at[v][sharing[0]].push_back(sharing[1]);
        next_at[v][sharing[1]].push_back(sharing[0]);
      }
    }
  }
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if (triangles_at[v].empty()) {
      fixed[v] = true;  // isolated
      continue;
    }
    std::set<std::size_t> fan{*triangles_at[v].begin()};
    std::vector<std::size_t> reached(fan.begin(), fan.end());
    while (!reached.empty()) {
      const std::size_t t = reached.back();
      reached.pop_back();
      for (const std::size_t next : next_at[v][t]) {
        if (fan.insert(next).second) {
          reached.push_back(next);
        }
      }
    }
    fixed[v] = fixed[v] || fan != triangles_at[v];  // a bow tie
  }
}

}  // namespace

Connectivity connectivity_of(const RandomMesh& mesh) {
  Connectivity found;
  found.elements = mesh.mesh.triangles;
  found.fixed.assign(mesh.mesh.points.size(), false);
  Edges edges(found.elements);
  hold_what_the_mesh_holds(mesh, edges, found.fixed);
  for (std::size_t v = 0; v < found.fixed.size(); ++v) {
    const bool named = !mesh.fixed.empty() && mesh.fixed[v] != 0;
    const bool other_cell = !mesh.other_cells.empty() && mesh.other_cells[v] != 0;
    found.fixed[v] = found.fixed[v] || named || other_cell;
  }
  for (const std::int32_t v : mesh.fixed_ids) {
    found.fixed[v] = true;
  }

  const std::vector<double> xy = mesh.mesh.xy();
  const Units units(xy);
  found.component.resize(found.elements.size());
  std::set<std::size_t> left;
  for (std::size_t t = 0; t < found.elements.size(); ++t) {
    left.insert(left.end(), t);
  }
  while (!left.empty()) {
    const std::set<std::size_t> component = edges.list_alike(*left.begin());
    int balance = 0;
    double first = 0;
    bool is_held = false;
    bool is_free = false;
    for (const std::size_t t : component) {
      Triangle& element = found.elements[t];
      element = from_smallest(element);
      const auto sign = alpha<double>(units, xy, element);
      balance += (sign > 0 ? 1 : 0) - (sign < 0 ? 1 : 0);
      first = first == 0 ? sign : first;
      is_held = is_held || std::ranges::any_of(element, [&](std::int32_t v) { return found.fixed[v]; });
      is_free = is_free || std::ranges::any_of(element, [&](std::int32_t v) { return !found.fixed[v]; });
      found.component[t] = *component.begin();
      left.erase(t);
    }
    found.is_tied = found.is_tied || (balance == 0 && is_free);
    found.is_tied_anywhere = found.is_tied_anywhere || balance == 0;
    found.is_held = found.is_held && is_held;
    if (balance < 0 || (balance == 0 && first < 0)) {
      for (const std::size_t t : component) {
        Triangle& element = found.elements[t];
        std::swap(element[1], element[2]);
      }
    }
  }
  return found;
}

namespace {

/// The elements as they are turned now, after the result has turned components over; or what is wrong with that.
std::string elements_now(const Connectivity& connectivity, const Run& run, std::vector<Triangle>& elements) {
  elements = connectivity.elements;
  if (!run.result.untangling || run.result.untangling->turned.empty()) {
    const bool is_none = !run.result.untangling || run.result.untangling->turned_components == 0;
    return is_none ? std::string() : "it does not say which components are turned over";
  }
  const std::vector<std::uint8_t>& turned = run.result.untangling->turned;
  const Units units(run.xy);
  std::map<std::size_t, int> balance;
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const std::size_t component = connectivity.component[t];
    if (turned.size() != elements.size() || turned[t] != turned[component]) {
      return fmt::format("element {} is turned over, or not, by itself", t);
    }
    if (turned[t] != 0) {
      std::swap(elements[t][1], elements[t][2]);
      const auto sign = alpha<double>(units, run.xy, elements[t]);
      balance[component] += (sign > 0 ? 1 : 0) - (sign < 0 ? 1 : 0);
    }
  }
  for (const auto& [component, sum] : balance) {
    if (sum <= 0) {
      return fmt::format("the component of element {} is turned over the wrong way", component);
    }
  }
  const auto count = static_cast<std::int32_t>(balance.size());
  return run.result.untangling->turned_components == count
             ? std::string()
             : fmt::format("{} components are turned over, not {}", count, run.result.untangling->turned_components);
}

/// What is wrong with what the result says of untangling.
std::string miscount(const Connectivity& connectivity, const std::vector<Triangle>& elements, const Run& run,
                     std::span<const double> before) {
  if (!run.result.untangling || !keeps_digits(before) || !keeps_digits(run.xy)) {
    return {};  // nothing to tell, or another frame may lose other digits
  }
  const auto count = [&](const std::vector<Triangle>& of, std::span<const double> xy, bool is_free) {
    const Units units(before);
    return std::ranges::count_if(of, [&](const Triangle& t) {
      return is_free != std::ranges::all_of(t, [&](std::int32_t v) { return connectivity.fixed[v]; }) &&
             !(alpha<double>(units, xy, t) > 0);
    });
  };
  const trismooth::UntanglingResult& told = *run.result.untangling;
  const std::int64_t was = count(connectivity.elements, before, true);
  const std::int64_t is = count(elements, run.xy, true);
  const std::int64_t fixed = count(elements, before, false);
  if (told.inverted_before != was || told.inverted_after != is || told.inverted_fixed != fixed) {
    return fmt::format("{} elements were inverted, {} are, and {} of fixed vertices, not {}, {}, and {}", was, is,
                       fixed, told.inverted_before, told.inverted_after, told.inverted_fixed);
  }
  return {};
}

}  // namespace

std::string breach(const RandomMesh& mesh, const Connectivity& connectivity, const Run& run, bool guard) {
  const std::vector<double> before = mesh.mesh.xy();
  const std::vector<double>& after = run.xy;
  std::vector<double> unguarded = after;
  for (const auto& [vertex, position] : run.result.reverted) {
    unguarded[2 * vertex] = position.x;
    unguarded[2 * vertex + 1] = position.y;
  }
  const auto is_elsewhere = [&before](const std::vector<double>& xy, std::int32_t v) {
    return xy[2 * v] != before[2 * v] || xy[2 * v + 1] != before[2 * v + 1];
  };
  std::int64_t moved = 0;
  std::int64_t reverted = 0;
  std::int64_t free = 0;
  for (std::int32_t v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (!std::isfinite(after[2 * v]) || !std::isfinite(after[2 * v + 1])) {
      return fmt::format("vertex {} has gone to {} {}", v, after[2 * v], after[2 * v + 1]);
    }
    const bool moves = is_elsewhere(after, v);
    if (moves && connectivity.fixed[v]) {
      return fmt::format("fixed vertex {} moved", v);
    }
    if (!moves && !(same_bits(after[2 * v], before[2 * v]) && same_bits(after[2 * v + 1], before[2 * v + 1]))) {
      return fmt::format("vertex {} did not move, but its bits have changed", v);
    }
    moved += moves ? 1 : 0;
    reverted += unguarded[2 * v] != after[2 * v] || unguarded[2 * v + 1] != after[2 * v + 1] ? 1 : 0;
    free += connectivity.fixed[v] ? 0 : 1;
  }
  if (run.result.moved_vertices != moved || run.result.reverted_vertices != reverted ||
      run.result.free_vertices != free) {
    return fmt::format("{} of {} free vertices moved and {} reverted, but the result says {} of {} and {}", moved, free,
                       reverted, run.result.moved_vertices, run.result.free_vertices, run.result.reverted_vertices);
  }
  if (!guard) {
    return {};
  }

  std::vector<Triangle> now;
  if (const std::string wrong = elements_now(connectivity, run, now); !wrong.empty()) {
    return wrong;
  }
  if (const std::string wrong = miscount(connectivity, now, run, before); !wrong.empty()) {
    return wrong;
  }
  const Units units(before);
  double threshold = std::numeric_limits<double>::infinity();
  for (const Triangle& t : connectivity.elements) {
    if (std::ranges::any_of(t, [&](std::int32_t v) { return is_elsewhere(after, v); })) {
      threshold = std::min(threshold, alpha<double>(units, before, t));
    }
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Triangle& t = connectivity.elements[i];
    const auto was = alpha<double>(units, before, t);
    const auto is = alpha<double>(units, after, now[i]);
    if ((was > 0 && !(is > 0)) || !(is >= was || is >= threshold)) {
      return fmt::format("the element {} {} {} got worse, from {} to {}, with {} the worst touched", t[0], t[1], t[2],
                         was, is, threshold);
    }
    // The same with more digits: a few roundings of a number below 1 / 3 are left.
    constexpr double rounding = 1e-15;
    const auto truly_was = alpha<long double>(units, before, t);
    const auto truly_is = alpha<long double>(units, after, now[i]);
    if (truly_is < truly_was - rounding && truly_is < static_cast<long double>(threshold) - rounding) {
      return fmt::format("the element {} {} {} truly got worse, from {} to {}", t[0], t[1], t[2],
                         static_cast<double>(truly_was), static_cast<double>(truly_is));
    }
  }
  return {};
}

}  // namespace properties
