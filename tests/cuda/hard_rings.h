// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"

#include "support/test_meshes.h"

/// Vertices whose update is easy to get wrong where it is not computed as its definition says.
namespace hard_rings {

using test_meshes::Random;
using trismooth::Point2;

enum class Kind {
  ordinary,    ///< no inverted triangle, of usual shape
  tangled,     ///< in any order, inverted triangles
  degenerate,  ///< triangles without an area, neighbours that coincide, with each other or with the vertex
  near_mean,   ///< the vertex is a few units in the last place, or little more, from the mean of its neighbours
  tied,        ///< far from the mean, but nearly as good there
  near_zero,   ///< coordinates that are zero or next to nothing: on the axes, around the origin
};
inline constexpr int kinds = 6;

/// A ring in memory, on the host or on the device.
template <class T>
struct RingView {
  const Point2<T>* neighbours;
  std::int32_t count;

  constexpr TRISMOOTH_HOST_DEVICE std::int32_t size() const { return count; }
  constexpr TRISMOOTH_HOST_DEVICE Point2<T> operator[](int i) const { return neighbours[i]; }
};

template <class T>
struct Vertex {
  Kind kind;
  Point2<T> position;
  std::vector<Point2<T>> neighbours;

  std::int32_t ring_size() const { return static_cast<std::int32_t>(neighbours.size()); }
  RingView<T> ring() const { return {neighbours.data(), ring_size()}; }
};

template <class T>
constexpr bool is_float = sizeof(T) == sizeof(float);

inline bool one_in(Random& random, int n) {
  return random.below(n) == 0;
}

inline double random_sign(Random& random) {
  return one_in(random, 2) ? -1 : 1;
}

/// As many steps as `units` says to the next representable number.
template <class T>
T moved_by_units(T value, int units) {
  const T goal = std::copysign(T(8), static_cast<T>(units));
  for (int i = 0; i < std::abs(units); ++i) {
    value = std::nextafter(value, goal);
  }
  return value;
}

/// The same, moved by 0, 1 or 2 units in the last place or by up to a thousandth.
template <class T>
T nearly(T value, Random& random) {
  if (one_in(random, 2)) {
    return moved_by_units(value, random.below(5) - 2);
  }
  const double relative = std::pow(10, random.between(is_float<T> ? -8 : -16, -3));
  return static_cast<T>(value * (1 + random_sign(random) * relative));
}

template <class T>
Point2<T> nearly(Point2<T> point, Random& random) {
  const T x = nearly(point.x, random);
  return {x, nearly(point.y, random)};
}

template <class T>
Point2<T> at_angle(Point2<T> centre, double radius, double angle) {
  return {static_cast<T>(centre.x + radius * std::cos(angle)), static_cast<T>(centre.y + radius * std::sin(angle))};
}

/// Half the diameter of a ring: small ones have few digits.
template <class T>
double random_scale(Random& random) {
  return std::exp2(random.between(is_float<T> ? -12 : -36, 0));
}

/// A vertex that sees all of its neighbours, counter-clockwise.
template <class T>
Vertex<T> star(Point2<T> centre, double scale, int size, Random& random) {
  Vertex<T> vertex{Kind::ordinary, centre, {}};
  const double phase = random.between(0, 2 * std::numbers::pi);
  for (int i = 0; i < size; ++i) {
    const double angle = phase + 2 * std::numbers::pi * (i + random.between(-0.2, 0.2)) / size;
    vertex.neighbours.push_back(at_angle(centre, scale * random.between(0.5, 1.5), angle));
  }
  return vertex;
}

template <class T>
Point2<T> random_point(Random& random) {
  const double x = random.between(-1, 1);
  return {static_cast<T>(x), static_cast<T>(random.between(-1, 1))};
}

template <class T>
Point2<T>& any_neighbour(Vertex<T>& vertex, Random& random) {
  return vertex.neighbours[static_cast<std::size_t>(random.below(vertex.ring_size()))];
}

template <class T>
void tangle(Vertex<T>& vertex, double scale, Random& random) {
  if (one_in(random, 2)) {
    std::swap(any_neighbour(vertex, random), any_neighbour(vertex, random));
    return;
  }
  const Point2<T> centre = vertex.position;
  for (Point2<T>& neighbour : vertex.neighbours) {
    neighbour = at_angle(centre, scale * random.between(0, 1.5), random.between(0, 2 * std::numbers::pi));
  }
  vertex.position = at_angle(centre, scale * random.between(0, 1.5), random.between(0, 2 * std::numbers::pi));
}

template <class T>
void degenerate(Vertex<T>& vertex, Random& random) {
  const Point2<T> centre = vertex.position;
  const auto halfway = [](Point2<T> a, Point2<T> b) { return Point2<T>{(a.x + b.x) / 2, (a.y + b.y) / 2}; };
  for (int times = 1 + random.below(3); times > 0; --times) {
    Point2<T>& neighbour = any_neighbour(vertex, random);
    switch (random.below(6)) {
      case 0:
        neighbour = any_neighbour(vertex, random);
        break;
      case 1:
        neighbour = vertex.position;
        break;
      case 2:
        neighbour = halfway(centre, any_neighbour(vertex, random));
        break;
      case 3:
        vertex.position = neighbour;
        break;
      case 4:
        vertex.position = halfway(neighbour, any_neighbour(vertex, random));
        break;
      default:
        for (Point2<T>& other : vertex.neighbours) {
          other.y = one_in(random, 8) ? other.y : neighbour.y;
        }
    }
  }
}

/// Puts the vertex where its smallest quotient is nearly that at the mean, far from there if there is such a place.
template <class T>
void tie(Vertex<T>& vertex, double scale, Random& random) {
  const auto mean = trismooth::laplacian_position<T>(vertex.ring());
  const T quality_at_mean = trismooth::worst_quotient(mean, vertex.ring());
  const auto is_better = [&](Point2<T> point) {
    return trismooth::worst_quotient(point, vertex.ring()) > quality_at_mean;
  };
  vertex.position = mean;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    double better = 0.05 * scale;
    double worse = 3 * scale;
    if (is_better(at_angle(mean, better, angle)) && !is_better(at_angle(mean, worse, angle))) {
      for (int i = 0; i < 60; ++i) {
        const double middle = (better + worse) / 2;
        (is_better(at_angle(mean, middle, angle)) ? better : worse) = middle;
      }
      vertex.position = at_angle(mean, one_in(random, 2) ? better : worse, angle);
      break;
    }
  }
  if (!one_in(random, 4)) {
    vertex.position = nearly(vertex.position, random);
  }
}

template <class T>
T next_to_nothing(Random& random) {
  const double sign = random_sign(random);
  switch (random.below(4)) {
    case 0:
      return static_cast<T>(sign * 0.0);
    case 1:
      return static_cast<T>(sign * 1e-30);
    case 2:
      return static_cast<T>(sign) * moved_by_units(T(0x1p-20), random.below(5) - 2);
    default:
      return static_cast<T>(sign * std::pow(10, random.between(-30, -5)));
  }
}

/// A ring around the origin that is so small that squares and products of coordinates are subnormal or nothing.
template <class T>
Vertex<T> tiny(int size, Random& random) {
  const double scale = std::pow(10, is_float<T> ? random.between(-23, -18) : random.between(-163, -153));
  Vertex<T> vertex = star(Point2<T>{T(0), T(0)}, scale, size, random);
  vertex.position = at_angle(vertex.position, scale * random.between(0, 0.4), random.between(0, 2 * std::numbers::pi));
  return vertex;
}

template <class T>
Vertex<T> near_zero(int size, Random& random) {
  Point2<T> centre = random_point<T>(random);
  double scale = random_scale<T>(random);
  switch (random.below(4)) {
    case 0:
      return tiny<T>(size, random);
    case 1:
      centre.x = next_to_nothing<T>(random);
      break;
    case 2:
      centre.y = next_to_nothing<T>(random);
      break;
    default:
      centre = {next_to_nothing<T>(random), next_to_nothing<T>(random)};
      scale = std::pow(10, random.between(-30, 0));
  }
  Vertex<T> vertex = star(centre, scale, size, random);
  const int density = 2 + random.below(6);
  for (Point2<T>& neighbour : vertex.neighbours) {
    neighbour.x = one_in(random, density) ? next_to_nothing<T>(random) : neighbour.x;
    neighbour.y = one_in(random, density) ? next_to_nothing<T>(random) : neighbour.y;
  }
  if (one_in(random, 4)) {
    vertex.position = nearly(trismooth::laplacian_position<T>(vertex.ring()), random);
  }
  return vertex;
}

template <class T>
Vertex<T> any(Kind kind, int size, Random& random) {
  if (kind == Kind::near_zero) {
    Vertex<T> vertex = near_zero<T>(size, random);
    vertex.kind = kind;
    return vertex;
  }
  const double scale = random_scale<T>(random);
  Vertex<T> vertex = star(random_point<T>(random), scale, size, random);
  vertex.kind = kind;
  if (kind == Kind::tangled) {
    tangle(vertex, scale, random);
  } else if (kind == Kind::degenerate) {
    degenerate(vertex, random);
  } else if (kind == Kind::near_mean) {
    vertex.position = nearly(trismooth::laplacian_position<T>(vertex.ring()), random);
  } else if (kind == Kind::tied) {
    tie(vertex, scale, random);
  }
  return vertex;
}

/// `count` of them, and which ones are to be evaluated. Each 32 in a row, a warp's, have something in common: the same
/// size, 3 to 8 neighbours, 3 to 12, or 1 to 40; all of them are active, some or none.
template <class T>
struct Vertices {
  std::vector<Vertex<T>> all;
  std::vector<std::uint8_t> active;

  Vertices(int count, std::uint64_t seed) {
    Random random(seed);
    int style = 0;
    int same_size = 0;
    int activity = 0;
    for (int i = 0; i < count; ++i) {
      if (i % 32 == 0) {
        style = random.below(4);
        same_size = 3 + random.below(10);
        activity = random.below(16);
      }
      const int sizes[] = {same_size, 3 + random.below(6), 3 + random.below(10),
                           1 + random.below(one_in(random, 8) ? 40 : 16)};
      all.push_back(any<T>(static_cast<Kind>(random.below(kinds)), sizes[style], random));
      active.push_back(activity < 10 || (activity < 15 && !one_in(random, 4)) ? 1 : 0);
    }
  }
};

}  // namespace hard_rings
