// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/options.h"

/// The mean-ratio method once more: its energy as its definition says it, and what it aims at, bit for bit.
namespace naive {

using trismooth::Point2;

using Real = long double;

template <class T>
Point2<Real> widened(Point2<T> p) {
  return {static_cast<Real>(p.x), static_cast<Real>(p.y)};
}

inline Real doubled_area(Point2<Real> a, Point2<Real> b, Point2<Real> c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline Real sum_of_squares(Point2<Real> a, Point2<Real> b, Point2<Real> c) {
  const auto squared = [](Point2<Real> p, Point2<Real> q) {
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
  };
  return squared(a, b) + squared(b, c) + squared(c, a);
}

/// What a growth bound is a bound of.
inline Real share(Point2<Real> a, Point2<Real> b, Point2<Real> c) {
  return doubled_area(a, b, c) * sum_of_squares(a, b, c);
}

/// A symmetric tensor: the sum of e e^T over edges e.
struct Tensor {
  Real xx = 0;
  Real xy = 0;
  Real yy = 0;
};

/// A vertex's ring with all that the energy around it asks for.
struct EnergyRing {
  std::vector<Point2<Real>> positions;
  std::vector<Real> inverse_areas;  ///< 1 / (twice the area aimed at) around each neighbour
  Real own_inverse_area = 1;        ///< around the vertex
  Real third_of_weight = 0;         ///< lambda / 3
  int power = 1;                    ///< p
  std::vector<Tensor> edges{};      ///< around the neighbours, or none: shapes are equilateral
  Tensor own_edges{};               ///< around the vertex

  std::size_t next(std::size_t i) const { return (i + 1) % positions.size(); }

  /// alpha of the triangle on side i where the vertex is at v: 2 det(M) / |M|^2, where M maps an equilateral triangle
  /// onto this one, seen in coordinates in which the edges around its corners have no direction. 1 where it is
  /// equilateral there.
  Real alpha(std::size_t i, Point2<Real> v) const {
    const Point2<Real> o{0, 0};
    const Point2<Real> p{1, 0};
    const Point2<Real> q{0.5L, std::sqrt(3.0L) / 2};
    Tensor sum{1, 0, 1};
    if (!edges.empty()) {
      const Tensor& of_a = edges[i];
      const Tensor& of_b = edges[next(i)];
      sum = {own_edges.xx + of_a.xx + of_b.xx, own_edges.xy + of_a.xy + of_b.xy, own_edges.yy + of_a.yy + of_b.yy};
    }
    // The inverse of the lower triangular matrix L with L L^T = sum, up to a factor.
    const Real l = sum.xy / sum.xx;
    const Real across = std::sqrt(sum.yy / sum.xx - l * l);
    const auto seen = [&](Point2<Real> e) { return Point2<Real>{e.x, (e.y - l * e.x) / across}; };
    const Point2<Real> to_a = seen({positions[i].x - v.x, positions[i].y - v.y});
    const Point2<Real> to_b = seen({positions[next(i)].x - v.x, positions[next(i)].y - v.y});
    const Real determinant = doubled_area(o, p, q);
    // The inverse of the matrix of columns p - o and q - o.
    const Real xx = (q.y - o.y) / determinant;
    const Real xy = -(q.x - o.x) / determinant;
    const Real yx = -(p.y - o.y) / determinant;
    const Real yy = (p.x - o.x) / determinant;
    const Real m[4] = {to_a.x * xx + to_b.x * yx, to_a.x * xy + to_b.x * yy, to_a.y * xx + to_b.y * yx,
                       to_a.y * xy + to_b.y * yy};
    return 2 * (m[0] * m[3] - m[1] * m[2]) / (m[0] * m[0] + m[1] * m[1] + m[2] * m[2] + m[3] * m[3]);
  }

  /// Twice the smallest area of the triangles.
  Real smallest_area(Point2<Real> v) const {
    Real smallest = doubled_area(v, positions[0], positions[next(0)]);
    for (std::size_t i = 1; i < positions.size(); ++i) {
      smallest = std::min(smallest, doubled_area(v, positions[i], positions[next(i)]));
    }
    return smallest;
  }

  /// The sum of alpha^-p + p lambda / 3 (tau + 1 / tau). Every area is positive.
  Real energy(Point2<Real> v) const {
    Real sum = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Real inverse_area = (own_inverse_area + inverse_areas[i] + inverse_areas[next(i)]) / 3;
      const Real tau = doubled_area(v, positions[i], positions[next(i)]) * inverse_area;
      sum += std::pow(alpha(i, v), static_cast<Real>(-power)) + power * third_of_weight * (tau + 1 / tau);
    }
    return sum;
  }
};

/// What the method aims at, by vertex.
template <class T>
struct MeanRatioAims {
  std::vector<T> inverse_areas;
  std::vector<T> largest_shares;
  std::vector<trismooth::EdgeTensor<T>> edges;
  trismooth::MeanRatioScales<T> scales{};

  trismooth::MeanRatioTargets<T> view() const {
    return {inverse_areas.data(), largest_shares.data(), &scales, edges.empty() ? nullptr : edges.data()};
  }
};

/// The aims of a mesh, from the positions before the first sweep.
template <class T>
MeanRatioAims<T> mean_ratio_aims(const std::vector<Point2<T>>& points,
                                 const std::vector<std::vector<std::int32_t>>& rings,
                                 const trismooth::MeanRatioOptions& options) {
  constexpr double sqrt_12 = 3.4641016151377545870548926830117;
  const std::size_t size = points.size();
  const auto area = [&](std::size_t v, std::int32_t a, std::int32_t b) {
    const T ax = points[a].x - points[v].x;
    const T ay = points[a].y - points[v].y;
    const T bx = points[b].x - points[v].x;
    const T by = points[b].y - points[v].y;
    const T found = ax * by - ay * bx;
    return found > 0 ? found : T(0);
  };
  const auto squares = [&](std::size_t v, std::int32_t a, std::int32_t b) {
    const auto squared = [](Point2<T> p, Point2<T> q) { return (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y); };
    return squared(points[v], points[a]) + squared(points[v], points[b]) + squared(points[a], points[b]);
  };
  // Means around free vertices, largest shares, and sums over the mesh, of which whole units count.
  std::vector<T> mean(size, 0);
  std::vector<T> largest(size, 0);
  __extension__ using Int128 = __int128;
  Int128 all_areas = 0;  // in units of 2^-94
  std::uint64_t all_quotients = 0;
  double count = 0;
  struct Corner {
    double area;
    std::uint64_t times;
  };
  std::vector<std::vector<Corner>> around_fixed(size);
  for (std::size_t v = 0; v < size; ++v) {
    T sum = 0;
    const auto& ring = rings[v];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::int32_t a = ring[(i + ring.size() - 1) % ring.size()];
      const std::int32_t b = ring[i];
      const T found = area(v, a, b);
      sum += found;
      ++count;
      if (found > 0) {
        largest[v] = std::max(largest[v], found * squares(v, a, b));
        all_quotients += static_cast<std::uint64_t>(std::ldexp(static_cast<double>(found / squares(v, a, b)), 28));
      }
      const bool a_is_fixed = rings[a].empty();
      const bool b_is_fixed = rings[b].empty();
      // Seen from each of its free corners, a triangle counts twice in all.
      const std::uint64_t times = a_is_fixed && b_is_fixed ? 2 : 1;
      if (a_is_fixed) {
        around_fixed[a].push_back({static_cast<double>(found), times});
      }
      if (b_is_fixed) {
        around_fixed[b].push_back({static_cast<double>(found), times});
      }
    }
    all_areas += static_cast<Int128>(std::ldexp(static_cast<Real>(sum), 94));
    mean[v] = ring.empty() ? T(0) : sum / static_cast<T>(ring.size());
  }
  for (std::size_t v = 0; v < size; ++v) {
    if (rings[v].empty() && !around_fixed[v].empty()) {
      double most = 0;
      for (const Corner& corner : around_fixed[v]) {
        most = std::max(most, corner.area);
      }
      // The largest area has 40 bits.
      const int power = most > 0 ? std::min(40 - std::ilogb(most), 1023) : 1023;
      std::uint64_t sum = 0;
      std::uint64_t times = 0;
      for (const Corner& corner : around_fixed[v]) {
        sum += corner.times * static_cast<std::uint64_t>(std::ldexp(corner.area, power));
        times += corner.times;
      }
      mean[v] = static_cast<T>(std::ldexp(static_cast<double>(sum) / static_cast<double>(times), -power));
    }
  }

  count = std::max(count, 1.0);
  const double mean_shape = sqrt_12 * (std::ldexp(static_cast<double>(all_quotients), -28) / count);
  const double trust = mean_shape * mean_shape * (mean_shape * mean_shape) * mean_shape;
  const auto mesh_area = static_cast<T>(std::ldexp(static_cast<double>(all_areas), -94) / count);
  MeanRatioAims<T> aims;
  aims.scales.size_weight = static_cast<T>(options.size_weight * trust / 3);
  aims.scales.power = options.power > 0 ? options.power : (mean_shape >= 0.8 ? 3 : 2);
  for (std::size_t v = 0; v < size; ++v) {
    const T allowed_area = static_cast<T>(1.5 / trust) * std::max(mean[v], mesh_area);
    const T allowed = allowed_area * (static_cast<T>(sqrt_12) * allowed_area);
    aims.largest_shares.push_back(allowed > largest[v] ? allowed : largest[v]);
    aims.inverse_areas.push_back(1 / (mean[v] > 0 ? mean[v] : mesh_area));
  }
  if (options.target == trismooth::TargetShape::input) {
    std::vector<trismooth::EdgeTensor<T>> around(size);
    for (std::size_t v = 0; v < size; ++v) {
      const auto& ring = rings[v];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::int32_t a = ring[(i + ring.size() - 1) % ring.size()];
        const std::int32_t b = ring[i];
        if (area(v, a, b) > 0) {
          const Point2<T> to_a{points[a].x - points[v].x, points[a].y - points[v].y};
          const Point2<T> to_b{points[b].x - points[v].x, points[b].y - points[v].y};
          for (const Point2<T> e : {to_a, to_b, Point2<T>{to_b.x - to_a.x, to_b.y - to_a.y}}) {
            around[v].xx += e.x * e.x;
            around[v].xy += e.x * e.y;
            around[v].yy += e.y * e.y;
          }
        }
      }
    }
    aims.edges = around;
    for (std::size_t v = 0; v < size; ++v) {
      for (const std::int32_t n : rings[v]) {
        aims.edges[v].xx += around[n].xx;
        aims.edges[v].xy += around[n].xy;
        aims.edges[v].yy += around[n].yy;
      }
    }
  }
  return aims;
}

}  // namespace naive
