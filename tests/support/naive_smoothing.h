// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

#include "support/naive_mean_ratio.h"

/// The smoothing once more, written down as the contract says it, with no thought of speed: what the engine must equal
/// bit for bit. Shares no code with it but plain structures, and the mean-ratio method's update of one vertex, which
/// tests/smoothing/mean_ratio.cpp holds to the definition of its energy. Triangles are listed counter-clockwise.
namespace naive {

using trismooth::Form;
using trismooth::Method;
using trismooth::Point2;
using trismooth::StopReason;
using trismooth::Triangle;
using Rings = std::vector<std::vector<std::int32_t>>;

/// The shape without its constant.
template <class T>
T quotient(Point2<T> a, Point2<T> b, Point2<T> c) {
  const T ab_x = b.x - a.x;
  const T ab_y = b.y - a.y;
  const T ac_x = c.x - a.x;
  const T ac_y = c.y - a.y;
  const T bc_x = c.x - b.x;
  const T bc_y = c.y - b.y;
  const T sum = (ab_x * ab_x + ab_y * ab_y) + (bc_x * bc_x + bc_y * bc_y) + (ac_x * ac_x + ac_y * ac_y);
  return sum == 0 ? T(0) : (ab_x * ac_y - ab_y * ac_x) / sum;
}

/// The same of an element as reports and the guard see it: from its smallest index on.
inline double element_quotient(std::span<const Point2<double>> points, Triangle t) {
  while (t[0] > t[1] || t[0] > t[2]) {
    t = {t[1], t[2], t[0]};
  }
  return quotient(points[t[0]], points[t[1]], points[t[2]]);
}

/// One-rings of the free vertices: all but those on an edge with one triangle. No ring for the others, and for the
/// `fixed` ones. For manifold meshes.
inline Rings one_rings(std::int32_t vertex_count, std::span<const Triangle> triangles,
                       const std::set<std::int32_t>& fixed = {}) {
  std::vector<std::map<std::int32_t, std::int32_t>> following(static_cast<std::size_t>(vertex_count));
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      following[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3];
    }
  }
  Rings rings(following.size());
  for (std::int32_t v = 0; v < vertex_count; ++v) {
    const bool is_fixed =
        following[v].empty() || fixed.contains(v) ||
        std::ranges::any_of(following[v], [&](auto& link) { return !following[v].contains(link.second); });
    if (!is_fixed) {
      const std::int32_t first = following[v].begin()->first;
      std::int32_t neighbour = first;
      do {
        rings[v].push_back(neighbour);
        neighbour = following[v].at(neighbour);
      } while (neighbour != first);
    }
  }
  return rings;
}

/// SplitMix64 as its authors print it: a state that advances, and the output made from it.
inline std::uint64_t hashed(std::uint64_t state) {
  state += 0x9e3779b97f4a7c15U;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// The vertices of each colour: greedy, in the order of their hashes.
inline std::vector<std::vector<std::int32_t>> colour_classes(const Rings& rings) {
  std::map<std::uint64_t, std::int32_t> order;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (!rings[v].empty()) {
      order[hashed(v)] = static_cast<std::int32_t>(v);
    }
  }
  std::map<std::int32_t, std::size_t> colours;
  std::vector<std::vector<std::int32_t>> classes;
  for (const auto& [hash, v] : order) {
    std::set<std::size_t> taken;
    for (const std::int32_t neighbour : rings[v]) {
      if (const auto found = colours.find(neighbour); found != colours.end()) {
        taken.insert(found->second);
      }
    }
    std::size_t colour = 0;
    while (taken.contains(colour)) {
      ++colour;
    }
    colours[v] = colour;
    classes.resize(std::max(classes.size(), colour + 1));
    classes[colour].push_back(v);
  }
  return classes;
}

template <class T>
using Ring = std::vector<Point2<T>>;

template <class T>
T smallest_quotient(Point2<T> position, const Ring<T>& ring) {
  T smallest = std::numeric_limits<T>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    smallest = std::min(smallest, quotient(position, ring[i], ring[(i + 1) % ring.size()]));
  }
  return smallest;
}

template <class T>
int inverted(Point2<T> position, const Ring<T>& ring) {
  int count = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    count += quotient(position, ring[i], ring[(i + 1) % ring.size()]) < 0 ? 1 : 0;
  }
  return count;
}

template <class T>
Point2<T> laplacian(const Ring<T>& ring) {
  Point2<T> sum = ring.front();
  for (std::size_t i = 1; i < ring.size(); ++i) {
    sum = {sum.x + ring[i].x, sum.y + ring[i].y};
  }
  const T weight = 1 / static_cast<T>(ring.size());
  return {sum.x * weight, sum.y * weight};
}

template <class T>
Point2<T> weighted(Point2<T> position, const Ring<T>& ring) {
  T lengths = 0;
  Point2<T> sum{0, 0};
  for (const Point2<T> neighbour : ring) {
    const T x = neighbour.x - position.x;
    const T y = neighbour.y - position.y;
    const T length = std::sqrt(x * x + y * y);
    lengths += length;
    sum = {sum.x + length * x, sum.y + length * y};
  }
  const T step = 2 / (3 * lengths);
  return {position.x + step * sum.x, position.y + step * sum.y};
}

/// Whether the method's formula is here as well. What others say of a vertex is asked of themselves, whose own tests
/// have it in another form.
constexpr bool has_formula(Method method) {
  return method == Method::smart || method == Method::laplacian || method == Method::weighted;
}

/// Where a method with a formula puts the vertex; `position` itself where it stays.
template <class T>
Point2<T> updated(Method method, Point2<T> position, const Ring<T>& ring) {
  const Point2<T> target = method == Method::weighted ? weighted(position, ring) : laplacian(ring);
  if (!std::isfinite(target.x) || !std::isfinite(target.y)) {
    return position;
  }
  if (method != Method::laplacian && (!(smallest_quotient(target, ring) > smallest_quotient(position, ring)) ||
                                      inverted(target, ring) > inverted(position, ring))) {
    return position;
  }
  return target;
}

struct SweepCount {
  std::int64_t moved = 0;
  std::int64_t changed = 0;  ///< vertices whose closed neighbourhood differs from what their last update read
  double max_relative_move = 0;
  double min_shape = 0;  ///< of the triangles with a free vertex, after the sweep
};

struct Outcome {
  std::vector<SweepCount> sweeps;
  StopReason reason = StopReason::fixed_point;
};

/// A ring as methods ask for it that know more of a vertex than its ring.
template <class T>
struct NumberedRing {
  const Ring<T>& positions;
  const std::vector<std::int32_t>& numbers;

  int size() const { return static_cast<int>(positions.size()); }
  Point2<T> operator[](int i) const { return positions[static_cast<std::size_t>(i)]; }
  std::int32_t number(int i) const { return numbers[static_cast<std::size_t>(i)]; }
};

/// The stages of the mean-ratio method: ten sweeps, and ten more as long as much moves, then the last. Of a steady one
/// the last alone, until nothing moves.
class MeanRatioStages {
 public:
  MeanRatioStages(Form form, std::size_t free_count, bool is_steady)
      : form_(form),
        free_count_(static_cast<double>(free_count)),
        is_steady_(is_steady),
        is_last_(free_count == 0 || is_steady) {}

  bool is_last() const { return is_last_; }
  bool is_few(std::int64_t moved) const {
    return is_last_ && static_cast<double>(moved) <= (is_steady_ ? 0 : free_count_ / 64);
  }
  template <class T>
  trismooth::MeanRatioStep<T> step() const {
    const double in_place = is_last_ ? 1.5 : 1.8;
    return {static_cast<T>(form_ == Form::swap ? 0.7 : in_place), static_cast<T>(goes_far_ ? 1e-4 : 3e-4), is_last_,
            is_steady_};
  }
  /// Whether the stage ends with this sweep and another one begins.
  bool ends(std::int64_t moved, bool is_settled) {
    ++sweep_of_stage_;
    if (is_last_ || (!is_settled && sweep_of_stage_ < 10)) {
      return false;
    }
    sweep_of_stage_ = 0;
    const double part = static_cast<double>(moved) / std::max(free_count_, 1.0);
    is_last_ = is_settled || !(part > (goes_far_ ? 0.25 : 0.875));
    goes_far_ = goes_far_ || !is_last_;
    return true;
  }

 private:
  Form form_;
  double free_count_;
  bool is_steady_;
  bool is_last_;
  bool goes_far_ = false;
  int sweep_of_stage_ = 0;
};

/// All sweeps: every free vertex in every one. `max_sweeps` is not 0.
template <class T>
Outcome smooth(std::vector<Point2<T>>& points, const Rings& rings, Method method, Form form, double tolerance,
               std::int64_t max_sweeps, const trismooth::MeanRatioOptions& mean_ratio = {}) {
  const bool is_mean_ratio = method == Method::mean_ratio;
  const MeanRatioAims<T> aims = is_mean_ratio ? mean_ratio_aims(points, rings, mean_ratio) : MeanRatioAims<T>{};
  std::vector<std::int32_t> visited;
  for (const auto& colour : colour_classes(rings)) {
    visited.insert(visited.end(), colour.begin(), colour.end());
  }
  MeanRatioStages stages(form, visited.size(), mean_ratio.steady);
  const auto update = [&](std::int32_t v, Point2<T> position, const Ring<T>& ring) {
    if (has_formula(method)) {
      return updated(method, position, ring);
    }
    const NumberedRing<T> numbered{ring, rings[v]};
    return trismooth::visit_method(
        trismooth::MethodInUse<T>{method, aims.view(), stages.template step<T>()},
        [&](const auto& by) { return trismooth::updated(by, v, position, numbered).position; });
  };
  std::vector<Ring<T>> last_read(points.size());
  Outcome outcome;
  for (;;) {
    const std::vector<Point2<T>> old = points;
    const std::vector<Point2<T>>& source = form == Form::swap ? old : points;
    SweepCount count;
    bool within_tolerance = true;
    T largest = 0;
    for (const std::int32_t v : visited) {
      Ring<T> ring;
      for (const std::int32_t neighbour : rings[v]) {
        ring.push_back(source[neighbour]);
      }
      const Point2<T> position = source[v];
      Ring<T> read = ring;
      read.push_back(position);
      count.changed += read == last_read[v] ? 0 : 1;
      last_read[v] = read;

      const Point2<T> target = update(v, position, ring);
      if (!(target == position)) {
        ++count.moved;
        T sum = 0;
        for (const Point2<T> n : ring) {
          sum += (n.x - position.x) * (n.x - position.x) + (n.y - position.y) * (n.y - position.y);
        }
        const Point2<T> step{target.x - position.x, target.y - position.y};
        const T move = (step.x * step.x + step.y * step.y) * static_cast<T>(ring.size());
        const T limit = static_cast<T>(tolerance) * static_cast<T>(tolerance) * sum;
        within_tolerance = within_tolerance && move <= limit;
        largest = std::max(largest, sum > 0 ? move / sum : T(0));
      }
      points[v] = target;
    }
    count.max_relative_move = static_cast<double>(std::sqrt(largest));
    T worst = std::numeric_limits<T>::infinity();
    for (const std::int32_t v : visited) {
      Ring<T> ring;
      for (const std::int32_t neighbour : rings[v]) {
        ring.push_back(points[neighbour]);
      }
      worst = std::min(worst, smallest_quotient(points[v], ring));
    }
    count.min_shape = 2 * std::sqrt(3.0) * static_cast<double>(worst);
    outcome.sweeps.push_back(count);
    const bool is_settled = count.moved == 0 || within_tolerance;
    const bool may_settle = !is_mean_ratio || stages.is_last();
    const bool is_few = is_mean_ratio && stages.is_few(count.moved);
    const bool is_limit = static_cast<std::int64_t>(outcome.sweeps.size()) == max_sweeps;
    if ((may_settle && is_settled) || is_few || is_limit) {
      outcome.reason = may_settle && count.moved == 0   ? StopReason::fixed_point
                       : may_settle && within_tolerance ? StopReason::tolerance
                       : is_few                         ? StopReason::few_moves
                                                        : StopReason::sweep_limit;
      return outcome;
    }
    if (is_mean_ratio && stages.ends(count.moved, is_settled)) {
      // Every vertex is evaluated anew.
      std::ranges::fill(last_read, Ring<T>{});
    }
  }
}

struct Guarded {
  std::vector<std::int32_t> reverted;  ///< ascending
  std::int64_t rounds = 0;
};

/// T of the guard: the smallest quotient before among the elements with a vertex that is elsewhere after.
inline double touched_minimum(std::span<const Triangle> triangles, std::span<const Point2<double>> before,
                              std::span<const Point2<double>> after) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    if (std::ranges::any_of(t, [&](std::int32_t v) { return !(before[v] == after[v]); })) {
      smallest = std::min(smallest, element_quotient(before, t));
    }
  }
  return smallest;
}

/// Whether the element was made worse in the contract's sense.
inline bool offends(double before, double after, double threshold) {
  const bool lost = before > 0 && !(after > 0);
  const bool worse = after < threshold && after < before;
  return lost || worse;
}

/// the never-worse guard, looking at every element in every round.
inline Guarded guard(std::span<const Triangle> triangles, std::span<const Point2<double>> before,
                     std::span<Point2<double>> after) {
  std::set<std::int32_t> reverted;
  Guarded result;
  for (;;) {
    const double threshold = touched_minimum(triangles, before, after);
    std::set<std::int32_t> back;
    for (const Triangle& t : triangles) {
      if (offends(element_quotient(before, t), element_quotient(after, t), threshold)) {
        std::ranges::copy_if(t, std::inserter(back, back.end()),
                             [&](std::int32_t v) { return !(before[v] == after[v]); });
      }
    }
    if (back.empty()) {
      result.reverted.assign(reverted.begin(), reverted.end());
      return result;
    }
    ++result.rounds;
    for (const std::int32_t v : back) {
      after[v] = before[v];
    }
    reverted.merge(back);
  }
}

}  // namespace naive
