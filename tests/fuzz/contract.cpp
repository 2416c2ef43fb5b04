// SPDX-License-Identifier: BSD-3-Clause
#include "contract.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "trismooth/base/rounding.h"

namespace fuzz {

namespace {

std::vector<Triangle> counter_clockwise(std::span<const Triangle> triangles, const NaiveTopology& topology) {
  std::vector<Triangle> turned(triangles.begin(), triangles.end());
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (topology.reversed[t] != 0) {
      std::swap(turned[t][1], turned[t][2]);
    }
  }
  return turned;
}

naive::Rings rings_of(std::span<const Triangle> triangles, const NaiveTopology& topology) {
  std::set<std::int32_t> fixed;
  for (std::size_t v = 0; v < topology.fixed.size(); ++v) {
    if (topology.fixed[v] != 0) {
      fixed.insert(static_cast<std::int32_t>(v));
    }
  }
  return naive::one_rings(static_cast<std::int32_t>(topology.fixed.size()), triangles, fixed);
}

template <class T>
Point2<T> narrow(Point2<double> point) {
  return {static_cast<T>(point.x), static_cast<T>(point.y)};
}

template <class T>
ByContract smooth(std::span<const Point2<double>> points, std::span<const Triangle> listed,
                  const NaiveTopology& topology, const trismooth::SmoothingOptions& options,
                  trismooth::Storage storage) {
  const trismooth::LocalFrame frame = frame_of_used(points, topology.used);
  std::vector<Point2<double>> before(points.size());
  std::vector<Point2<T>> working(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    before[v] = frame.enter(points[v]);
    working[v] = narrow<T>(before[v]);
  }
  const std::vector<Triangle> triangles = counter_clockwise(listed, topology);
  ByContract result;
  result.outcome = naive::smooth(working, rings_of(triangles, topology), options.method, options.form,
                                 options.tolerance, options.max_sweeps, options.mean_ratio);
  result.points.assign(points.begin(), points.end());
  std::vector<Point2<double>> after = before;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!(working[v] == narrow<T>(before[v]))) {
      // The mean of the largest numbers may round to one beyond them.
      const bool wide = storage == trismooth::Storage::float64;
      const double largest =
          wide ? std::numeric_limits<double>::max() : static_cast<double>(std::numeric_limits<float>::max());
      const auto stored = [&](double x) {
        const double within = std::clamp(x, -largest, largest);
        return wide ? within : trismooth::rounded_to_float32(within);
      };
      const Point2<double> left = frame.leave({static_cast<double>(working[v].x), static_cast<double>(working[v].y)});
      result.points[v] = {stored(left.x), stored(left.y)};
      after[v] = frame.enter(result.points[v]);
    }
  }
  if (options.guard) {
    result.guarded = naive::guard(triangles, before, after);
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (after[v] == before[v]) {
      result.points[v] = points[v];
    }
  }
  return result;
}

}  // namespace

ByContract smooth_by_contract(std::span<const Point2<double>> points, std::span<const Triangle> triangles,
                              const NaiveTopology& topology, const trismooth::SmoothingOptions& options,
                              trismooth::Storage storage) {
  return options.precision == trismooth::Precision::double_precision
             ? smooth<double>(points, triangles, topology, options, storage)
             : smooth<float>(points, triangles, topology, options, storage);
}

}  // namespace fuzz
