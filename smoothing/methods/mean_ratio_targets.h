// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/methods/mean_ratio.h"

/// What the mean-ratio method aims at, found from the mesh as it is before the first sweep: in two passes over the free
/// vertices, of which the second needs sums over all of the first.
namespace trismooth {

/// A sum of areas in integers, so that no order of adding matters.
struct AreaSum {
  static constexpr int part_count = 3;

  /// 32 bits of every area each, from the highest on: in units of 2^-30, 2^-62 and 2^-94. The local frame is about 1
  /// wide; what is 2^-40 times as wide has areas of 14 bits still, and the sum of 2^31 areas of 4 does not overflow.
  std::uint64_t parts[part_count];

  constexpr TRISMOOTH_HOST_DEVICE void add(double area) {
    double rest = area * highest_units;
    for (std::uint64_t& part : parts) {
      const auto whole = static_cast<std::int64_t>(rest);
      part += static_cast<std::uint64_t>(whole);
      rest = (rest - static_cast<double>(whole)) * units_in_higher;
    }
  }
  constexpr TRISMOOTH_HOST_DEVICE void add(const AreaSum& other) {
    for (int i = 0; i < part_count; ++i) {
      parts[i] += other.parts[i];
    }
  }
  constexpr TRISMOOTH_HOST_DEVICE double value() const {
    double units = 0;
    for (int i = part_count - 1; i >= 0; --i) {
      units = units * (1 / units_in_higher) + static_cast<double>(parts[i]);
    }
    return units * (1 / highest_units);
  }

 private:
  static constexpr double highest_units = 0x1p30;  ///< in 1
  static constexpr double units_in_higher = 0x1p32;
};

/// Sums over the triangles of all free vertices, each counted once for every free corner. Integers, so that no order of
/// adding matters.
struct MeanRatioSums {
  static constexpr double quotient_unit = 0x1p-28;

  AreaSum areas;            ///< doubled, of those that are positive
  std::uint64_t quotients;  ///< shape quotients, of those that are positive
  std::uint64_t count;
  AreaSum sizes;  ///< areas asked for (see relative_sizes.h), which are above 0 and at most 4, where sizes are
  std::uint64_t
      worst_quotient;  ///< the smallest there, where sizes are asked for: as key_of(), which grows as it falls

  constexpr TRISMOOTH_HOST_DEVICE void add(const MeanRatioSums& other) {
    areas.add(other.areas);
    quotients += other.quotients;
    count += other.count;
    sizes.add(other.sizes);
    worst_quotient = worst_quotient > other.worst_quotient ? worst_quotient : other.worst_quotient;
  }
  static constexpr TRISMOOTH_HOST_DEVICE std::uint64_t key_of(double quotient) {
    return ~std::bit_cast<std::uint64_t>(quotient > 0 ? quotient : 0.0);
  }
  constexpr TRISMOOTH_HOST_DEVICE double least_quotient() const { return std::bit_cast<double>(~worst_quotient); }
};

/// What one vertex adds to the sums, and what it keeps: twice the mean area of its triangles (0 where none is positive)
/// and their largest share_of_error().
template <class T>
struct MeanRatioRing {
  MeanRatioSums sums;
  T mean_area;
  T largest_share;
};

template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE MeanRatioRing<T> measure_for_mean_ratio(Point2<T> position, const Ring& ring) {
  MeanRatioRing<T> result{};
  T areas = 0;
  for_elements_around(
      ring, [&](int i) { return spoke_to<T>(ring[from_last(ring, i)], position); },
      [&](const auto& corner) {
        const auto size = size_of(corner);
        const auto [area, squares] = size;
        ++result.sums.count;
        if (area > T(0)) {
          areas += area;
          const T share = share_of_error(area, squares);
          result.largest_share = share > result.largest_share ? share : result.largest_share;
          result.sums.quotients += static_cast<std::uint64_t>(static_cast<double>(quotient_of(corner, size)) *
                                                              (1 / MeanRatioSums::quotient_unit));
        }
      });
  result.sums.areas.add(static_cast<double>(areas));
  result.mean_area = areas / static_cast<T>(ring.size());
  return result;
}

/// Adds the edges of a triangle of these edges at its vertex, if it is positive.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE void add_edges(const TriangleCorner<Point2<T>>& corner, EdgeTensor<T>& edges) {
  const auto& [a, b] = corner;
  if (cross(a, b) > T(0)) {
    edges.add(a);
    edges.add(b);
    edges.add(b - a);
  }
}

/// Those of a quadrilateral.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE void add_edges(const QuadrilateralCorner<Point2<T>>& corner, EdgeTensor<T>& edges) {
  const auto& [a, o, b] = corner;
  if (cross(o, b - a) > T(0)) {
    edges.add(a);
    edges.add(b);
    edges.add(o - a);
    edges.add(o - b);
  }
}

/// The edges of the elements around a free vertex, each as often as it is in one, in the mesh as it is before the
/// first sweep. Those that are not positive do not count.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<T> edges_around(Point2<T> position, const Ring& ring) {
  EdgeTensor<T> edges;
  for_elements_around(
      ring, [&](int i) { return ring[from_last(ring, i)] - position; },
      [&](const auto& corner) { add_edges(corner, edges); });
  return edges;
}

/// The mean of these over a free vertex and its neighbours, but for a factor. Those of fixed vertices are zeros.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<T> edges_nearby(std::int32_t v, const EdgeTensor<T>* around,
                                                           const Ring& ring) {
  EdgeTensor<T> edges = around[v];
  for (int i = 0; i < ring.size(); ++i) {
    edges.add(around[ring.number(i)]);
  }
  return edges;
}

/// How far the edges of a free vertex are turned on the whole since a reference, as a complex number of length 1.
/// `before(u)`: where packed vertex u was.
template <class T, class Ring, class Before>
TRISMOOTH_HOST_DEVICE Point2<T> turn_of_edges(std::int32_t v, Point2<T> position, const Ring& ring,
                                              const Before& before) {
  Point2<T> sum{0, 0};
  for (int i = 0; i < ring.size(); ++i) {
    const Point2<T> was = before(ring.number(i)) - before(v);
    const Point2<T> now = ring[i] - position;
    sum.x += was.x * now.x + was.y * now.y;
    sum.y += was.x * now.y - was.y * now.x;
  }
  const T length = std::sqrt(sum.x * sum.x + sum.y * sum.y);
  return length > T(0) ? Point2<T>{sum.x / length, sum.y / length} : Point2<T>{1, 0};
}

/// Edges turned so.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE EdgeTensor<T> turned(const EdgeTensor<T>& edges, Point2<T> by) {
  const T cc = by.x * by.x;
  const T cs = by.x * by.y;
  const T ss = by.y * by.y;
  return {(cc * edges.xx + ss * edges.yy) - (cs + cs) * edges.xy, cs * (edges.xx - edges.yy) + (cc - ss) * edges.xy,
          (ss * edges.xx + cc * edges.yy) + (cs + cs) * edges.xy};
}

/// Targets of a reference, MeanRatioTargets::inverse_areas and largest_shares of a vertex, where the exponent of the
/// local frame is larger by so much. (Scales have no lengths.)
template <class T>
TRISMOOTH_HOST_DEVICE T inverse_area_in(T of_reference, int exponents) {
  return std::ldexp(of_reference, 2 * exponents);
}
template <class T>
TRISMOOTH_HOST_DEVICE T largest_share_in(T of_reference, int exponents) {
  return std::ldexp(of_reference, -4 * exponents);
}

/// The area asked for of an element, from 1 / (those of its vertices).
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T asked_area(T own, const TriangleCorner<T>& corner) {
  return T(3) / (own + corner.next + corner.previous);
}
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T asked_area(T own, const QuadrilateralCorner<T>& corner) {
  return T(4) / ((own + corner.opposite) + (corner.next + corner.previous));
}

/// What one vertex adds to the sums beside that, where sizes are asked for. `inverse_sizes`: see relative_sizes.h, by
/// packed vertex.
template <class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE void add_sizes(std::int32_t v, Point2<T> position, const T* inverse_sizes,
                                               const Ring& ring, MeanRatioSums& sums) {
  const T own = inverse_sizes[v];
  for_elements_around(
      ring, [&](int i) { return inverse_sizes[ring.number(i)]; },
      [&](const auto& corner) { sums.sizes.add(static_cast<double>(asked_area(own, corner))); });
  const std::uint64_t worst = MeanRatioSums::key_of(static_cast<double>(worst_quotient(position, ring)));
  sums.worst_quotient = sums.worst_quotient > worst ? sums.worst_quotient : worst;
}

/// What all vertices have in common.
struct MeanRatioMesh {
  double mean_area;    ///< doubled
  double size_weight;  ///< MeanRatioScales::size_weight
  int power;           ///< MeanRatioScales::power
  double allowance;    ///< a triangle may always become so many times as large as the mean of those around it
  /// Sizes asked for, times this, are 1 / (twice the area): all triangles together have the area that there is.
  double size_scale = 1;
  double least_quotient = 0;  ///< MeanRatioScales::least_quotient

  /// How large triangles of a mesh are tells what its maker wanted, the more the better they are shaped; where they are
  /// distorted their areas are accidents. So the weight of the sizes goes with the fifth power of the mean shape, and
  /// what the growth bound allows with its inverse. A mesh of good triangles affords a higher power, which sees to the
  /// worst of them; where most are bad, it would make the others worse. (Found by experiment: docs/mean_ratio.md.)
  ///
  /// Sizes that the user asks for are intended: they have their weight as it is, and the room that they need. For them
  /// shapes may get worse, but none worse than the worst was, which the never-worse guard would take back.
  static constexpr TRISMOOTH_HOST_DEVICE MeanRatioMesh of(const MeanRatioSums& sums, double size_weight, int power,
                                                          bool has_sizes = false) {
    const double count = sums.count > 0 ? static_cast<double>(sums.count) : 1;
    const double mean_shape =
        shape_constant * (static_cast<double>(sums.quotients) * MeanRatioSums::quotient_unit / count);
    const double trust = (mean_shape * mean_shape) * (mean_shape * mean_shape) * mean_shape;
    const int usual_power = mean_shape >= 0.8 ? 3 : 2;
    const double areas = sums.areas.value();
    MeanRatioMesh mesh{areas / count, size_weight * trust / 3, power > 0 ? power : usual_power, 1.5 / trust};
    if (has_sizes) {
      constexpr double a_little_above = 1 + 0x1p-10;  // the guard rounds in another way
      mesh.size_weight = size_weight / 3;
      mesh.allowance = 8;
      mesh.size_scale = sums.sizes.value() / areas;
      mesh.least_quotient = sums.count > 0 ? a_little_above * sums.least_quotient() : 0;
    }
    return mesh;
  }
};

template <class T>
constexpr TRISMOOTH_HOST_DEVICE MeanRatioScales<T> scales_of(const MeanRatioMesh& mesh) {
  return {static_cast<T>(mesh.size_weight), mesh.power, static_cast<T>(mesh.least_quotient)};
}

/// The growth bound of a vertex: the largest share of its triangles before, or that of an equilateral triangle that is
/// MeanRatioMesh::allowance times as large as the mean around the vertex or in the mesh, where that is more.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T growth_bound(T largest_share, T mean_area, const MeanRatioMesh& mesh) {
  const T of_mesh = static_cast<T>(mesh.mean_area);
  const T area = static_cast<T>(mesh.allowance) * (mean_area > of_mesh ? mean_area : of_mesh);
  // Doubled area A, edge length s: A = sqrt(3) / 2 s^2, so 3 s^2 = 2 sqrt(3) A.
  const T allowed = share_of_error(area, T(shape_constant) * area);
  return allowed > largest_share ? allowed : largest_share;
}

/// MeanRatioTargets::inverse_areas of a vertex.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T inverse_target_area(T mean_area, const MeanRatioMesh& mesh) {
  return T(1) / (mean_area > T(0) ? mean_area : static_cast<T>(mesh.mean_area));
}

/// MeanRatioTargets::inverse_areas of a vertex, where sizes are asked for.
template <class T>
constexpr TRISMOOTH_HOST_DEVICE T inverse_asked_area(T inverse_size, const MeanRatioMesh& mesh) {
  return inverse_size * static_cast<T>(mesh.size_scale);
}

/// Twice the mean area of the triangles around a fixed vertex, which has no ring: the sum comes from its free
/// neighbours, in integers, so that no order of adding matters. Their unit follows from the largest of the areas.
struct FixedVertexArea {
  std::uint64_t largest = 0;  ///< the bits of the largest doubled area, a double that is not negative
  std::uint64_t sum = 0;      ///< of doubled areas, in units, each triangle counted twice
  std::uint64_t count = 0;    ///< of triangles, each counted twice

  /// Units in 1. The largest area has 40 bits then.
  constexpr TRISMOOTH_HOST_DEVICE double units() const {
    constexpr int bias = 1023;
    constexpr int mantissa_bits = 52;
    const int exponent = static_cast<int>(largest >> mantissa_bits) - bias;
    const int of_unit = exponent > 39 - bias ? 40 - exponent : bias;
    return std::bit_cast<double>(static_cast<std::uint64_t>(of_unit + bias) << mantissa_bits);
  }
  constexpr TRISMOOTH_HOST_DEVICE double mean() const {
    return count > 0 ? static_cast<double>(sum) / (static_cast<double>(count) * units()) : 0;
  }
};

/// How often an element counts at each of its fixed corners from a free one, so that each counts twice from all of its
/// free corners together; in a ring with quadrilaterals, whose elements have three at most that are free, six times.
template <class Ring, class Corner, class IsFree>
constexpr TRISMOOTH_HOST_DEVICE std::uint64_t times_counted(const Corner& corner, const IsFree& is_free) {
  if constexpr (MixedRing<Ring>) {
    std::uint64_t free = 1;
    corner.for_each([&](int i) { free += is_free(i) ? 1 : 0; });
    return 6 / free;
  } else {
    return corner.all([&](int i) { return !is_free(i); }) ? 2 : 1;
  }
}

/// Calls visit(u, area, times) for the fixed corners u of the elements of a free vertex at `position`: twice the area
/// (see size_of()), 0 where it is not positive, and times_counted(). Vertices from `free_count` on are fixed.
template <class T, class Ring, class Visit>
constexpr TRISMOOTH_HOST_DEVICE void for_fixed_corners(Point2<T> position, const Ring& ring, std::int32_t free_count,
                                                       const Visit& visit) {
  for_elements_around(
      ring, [](int i) { return i; },
      [&](const auto& corner) {
        const auto is_free = [&](int i) { return ring.number(i) < free_count; };
        if (corner.all(is_free)) {
          return;
        }
        const T area = size_of(corner.with([&](int i) { return spoke_to<T>(ring[i], position); })).doubled_area;
        const double positive = area > T(0) ? static_cast<double>(area) : 0;
        const std::uint64_t times = times_counted<Ring>(corner, is_free);
        corner.for_each([&](int i) {
          if (!is_free(i)) {
            visit(ring.number(i), positive, times);
          }
        });
      });
}

}  // namespace trismooth
