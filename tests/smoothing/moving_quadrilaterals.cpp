// SPDX-License-Identifier: BSD-3-Clause
// Meshes with quadrilaterals that follow their boundary.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/mixed_meshes.h"
#include "support/refusal.h"
#include "support/same_bits.h"
#include "support/says.h"

namespace trismooth::moving_quadrilaterals_test {

using mixed_meshes::MixedMesh;
using test_support::refusal;
using Numbers = std::vector<double>;

constexpr double degree = std::numbers::pi / 180;

/// A square rotor in a round hole: rings of quadrilaterals that grow outwards, four to one. `has_triangles`: every
/// third is two triangles.
struct Rotor {
  static constexpr std::int32_t sectors = 48;
  static constexpr std::int32_t rings = 12;
  MixedMesh mesh;

  explicit Rotor(bool has_triangles) {
    for (std::int32_t j = 0; j <= rings; ++j) {
      const double radius = std::pow(4.0, static_cast<double>(j) / rings);
      for (std::int32_t i = 0; i < sectors; ++i) {
        const double angle = 2 * std::numbers::pi * i / sectors;
        const double r = j > 0 ? radius : 0.7 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        mesh.points.push_back({r * std::cos(angle), r * std::sin(angle)});
      }
    }
    for (std::int32_t j = 0; j < rings; ++j) {
      for (std::int32_t i = 0; i < sectors; ++i) {
        const std::int32_t a = j * sectors + i;
        const std::int32_t b = j * sectors + (i + 1) % sectors;
        if (has_triangles && (i + j) % 3 == 0) {
          mesh.elements.push_back({a, a + sectors, b + sectors, -1});
          mesh.elements.push_back({a, b + sectors, b, -1});
        } else {
          mesh.elements.push_back({a, a + sectors, b + sectors, b});
        }
      }
    }
  }

  bool is_inside(std::size_t v) const { return v >= sectors && v < std::size_t{sectors} * rings; }

  /// With the rotor turned; what is inside is anywhere.
  Numbers at(double angle) const {
    Numbers xy = mesh.xy();
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const auto [x, y] = mesh.points[v];
      if (v < sectors) {
        xy[2 * v] = std::cos(angle) * x - std::sin(angle) * y;
        xy[2 * v + 1] = std::sin(angle) * x + std::cos(angle) * y;
      } else if (is_inside(v)) {
        xy[2 * v] = 7.5;
        xy[2 * v + 1] = -3.25;
      }
    }
    return xy;
  }
};

SmoothingOptions smoothing_layers(int threads = 0) {
  SmoothingOptions options = moving_options();
  options.layers = Layers::smooth;
  options.threads = threads;
  return options;
}

double smallest_shape(const MixedMesh& mesh, const Numbers& xy) {
  double least = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    least = std::min(least, mixed_meshes::shape_by_definition(mesh, e, xy));
  }
  return least;
}

TEST_CASE("a rotor turns in quadrilaterals, and in both kinds, and no element is inverted") {
  const Rotor rotor(GENERATE(false, true));
  MovingMesh moving(rotor.mesh.points, rotor.mesh.elements, smoothing_layers());
  for (const double degrees : {10.0, 45.0, 90.0}) {
    CAPTURE(degrees);
    Numbers xy = rotor.at(degrees * degree);
    const Numbers boundary = xy;
    const FollowResult result = moving.follow(xy_points(xy));
    CHECK(smallest_shape(rotor.mesh, xy) > 0.05);
    CHECK(result.is_valid());
    CHECK(result.invalid_held == 0);
    CHECK(result.smoothing.quadrilaterals == std::count_if(rotor.mesh.elements.begin(), rotor.mesh.elements.end(),
                                                           [](const auto& e) { return e[3] >= 0; }));
    for (std::size_t v = 0; v < rotor.mesh.points.size(); ++v) {
      if (!rotor.is_inside(v)) {
        CHECK(same_bits(xy[2 * v], boundary[2 * v]));
        CHECK(same_bits(xy[2 * v + 1], boundary[2 * v + 1]));
      }
    }
  }
}

TEST_CASE("quadrilaterals follow to the same bits, whatever came before, and by any number of threads") {
  const Rotor rotor(true);
  MovingMesh alone(rotor.mesh.points, rotor.mesh.elements, smoothing_layers(1));
  Numbers expected = rotor.at(25 * degree);
  alone.follow(xy_points(expected));
  for (const int threads : {2, 5}) {
    MovingMesh moving(rotor.mesh.points, rotor.mesh.elements, smoothing_layers(threads));
    for (const double before : {40.0, -30.0}) {
      Numbers elsewhere = rotor.at(before * degree);
      moving.follow(xy_points(elsewhere), before > 0 ? MovingStart::reference : MovingStart::previous);
    }
    Numbers xy = rotor.at(25 * degree);
    moving.follow(xy_points(xy));
    CHECK((xy == expected));
  }
}

TEST_CASE("triangles among four numbers each follow as triangles do") {
  const MixedMesh mesh(9, 8, 0.2, 4, 3);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& element : mesh.elements) {
    REQUIRE(element[3] == -1);
    triangles.push_back({element[0], element[1], element[2]});
  }
  Numbers as_elements = mesh.xy();
  for (std::size_t v = 0; v < 10; ++v) {
    as_elements[2 * v + 1] -= 1.5;
  }
  Numbers as_triangles = as_elements;
  MovingMesh(mesh.points, mesh.elements).follow(xy_points(as_elements));
  MovingMesh(mesh.points, triangles).follow(xy_points(as_triangles));
  CHECK((as_elements == as_triangles));
}

TEST_CASE("quadrilaterals whose boundary moves as a rigid body move as one") {
  const MixedMesh mesh(16, 16, 0.2, 3);
  MovingMesh moving(mesh.points, mesh.elements);
  Numbers at_rest = mesh.xy();
  moving.follow(xy_points(at_rest));
  for (const double degrees : {30.0, 90.0, 170.0}) {
    CAPTURE(degrees);
    const double c = std::cos(degrees * degree);
    const double s = std::sin(degrees * degree);
    const auto moved = [&](const Numbers& from) {
      Numbers to(from.size());
      for (std::size_t i = 0; i < from.size(); i += 2) {
        to[i] = c * from[i] - s * from[i + 1] + 300;
        to[i + 1] = s * from[i] + c * from[i + 1] - 20;
      }
      return to;
    };
    Numbers xy = moved(mesh.xy());
    CHECK(moving.follow(xy_points(xy)).is_valid());
    const Numbers expected = moved(at_rest);
    double farthest = 0;
    for (std::size_t i = 0; i < xy.size(); ++i) {
      farthest = std::max(farthest, std::abs(xy[i] - expected[i]));
    }
    CHECK(farthest < 0.05);  // a twentieth of an edge: where sweeps stop depends on the last digits
  }
}

TEST_CASE("the shape of an element relative to the reference is that of the map at its worst corner") {
  for (const std::uint64_t thirds : {0U, 1U, 3U}) {
    const MixedMesh mesh(7, 6, 0.2, 9, thirds);
    MovingMesh moving(mesh.points, mesh.elements);
    const Numbers rest = mesh.xy();
    Numbers xy = rest;
    for (std::size_t i = 0; i < xy.size(); i += 2) {
      xy[i] = 3 * rest[i] + rest[i + 1];
      xy[i + 1] = 2 * rest[i + 1];
    }
    const FollowResult result = moving.follow(xy_points(xy));
    double least = std::numeric_limits<double>::infinity();
    double sum = 0;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const std::vector<std::int32_t> corners = mesh.corners(e);
      double of_element = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto sides = [&](const Numbers& of) {
          const auto place = [&](std::size_t corner, std::size_t axis) {
            return of[2 * static_cast<std::size_t>(corners[corner % corners.size()]) + axis];
          };
          return std::array{place(i + 1, 0) - place(i, 0), place(i + corners.size() - 1, 0) - place(i, 0),
                            place(i + 1, 1) - place(i, 1), place(i + corners.size() - 1, 1) - place(i, 1)};
        };
        const auto [a, b, c, d] = sides(rest);
        const auto [p, q, r, s] = sides(xy);
        const double determinant = a * d - b * c;
        const std::array map{(p * d - q * c) / determinant, (q * a - p * b) / determinant,
                             (r * d - s * c) / determinant, (s * a - r * b) / determinant};
        double squares = 0;
        for (const double entry : map) {
          squares += entry * entry;
        }
        of_element = std::min(of_element, 2 * (map[0] * map[3] - map[1] * map[2]) / squares);
      }
      least = std::min(least, of_element);
      sum += of_element;
    }
    CHECK(result.min_relative_shape == Approx(least));
    CHECK(result.mean_relative_shape == Approx(sum / static_cast<double>(mesh.elements.size())));
  }
}

TEST_CASE("what is no mesh is refused as smooth() refuses it, and what it takes is taken") {
  const auto refused_alike = [](const MixedMesh& mesh) {
    Numbers xy = mesh.xy();
    const std::string said = refusal([&] { smooth(xy_points(xy), mesh.elements); });
    CHECK(refusal([&] { (void)MovingMesh(mesh.points, mesh.elements); }) == said);
    return said;
  };
  const MixedMesh mesh(5, 4, 0.2, 3, 0);
  MixedMesh not_in_turn = mesh;
  std::swap(not_in_turn.elements[7][1], not_in_turn.elements[7][2]);
  CHECK(says(refused_alike(not_in_turn), "a quadrilateral whose corners are not listed in turn"));
  MixedMesh repeats = mesh;
  repeats.elements[7][2] = repeats.elements[7][0];
  CHECK(says(refused_alike(repeats), "element 7 repeats a vertex"));
  // Where nothing beside it contradicts it, it is inverted, which both count.
  MixedMesh alone(1, 1, 0, 1, 0);
  std::swap(alone.elements[0][1], alone.elements[0][2]);
  Numbers xy = alone.xy();
  CHECK(smooth(xy_points(xy), alone.elements).inverted == 1);
  const FollowResult result = MovingMesh(alone.points, alone.elements).follow(xy_points(xy));
  CHECK(result.smoothing.inverted == 1);
  CHECK_FALSE(result.is_valid());
  // Without elements there is nothing to do.
  MixedMesh none = mesh;
  none.elements.clear();
  CHECK(refused_alike(none) == "none");
  xy = none.xy();
  CHECK(MovingMesh(none.points, none.elements).follow(xy_points(xy)).smoothing.moved_vertices == 0);
  CHECK(same_bits(xy, none.xy()));
}

TEST_CASE("what a boundary makes of quadrilaterals that no place mends is counted and named") {
  const MixedMesh mesh(8, 8, 0.15, 5, 0);
  MovingMesh moving(mesh.points, mesh.elements);
  Numbers xy = mesh.xy();
  for (std::size_t v = 0; v <= 8; ++v) {
    xy[2 * v + 1] = 15;  // the floor above the ceiling
  }
  const FollowResult result = moving.follow(xy_points(xy));
  std::vector<std::int32_t> invalid;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!(mixed_meshes::shape_by_definition(mesh, e, xy) > 0)) {
      invalid.push_back(static_cast<std::int32_t>(e));
    }
  }
  CHECK_FALSE(invalid.empty());
  CHECK_FALSE(result.is_valid());
  CHECK(result.smoothing.inverted + result.smoothing.degenerate == static_cast<std::int64_t>(invalid.size()));
  CHECK(result.invalid == invalid);
  CHECK(result.min_relative_shape < 0);
}

TEST_CASE("a hole in quadrilaterals that is turned inside out is told") {
  const Rotor rotor(false);
  MovingMesh moving(rotor.mesh.points, rotor.mesh.elements, smoothing_layers());
  Numbers xy = rotor.at(0);
  for (std::size_t v = 0; v < Rotor::sectors; ++v) {
    xy[2 * v] = -xy[2 * v];
  }
  const FollowResult result = moving.follow(xy_points(xy));
  CHECK_FALSE(result.is_valid());
  // Seen from inside, the sides of an element at the hole no longer turn as they did.
  CHECK((!result.overlaps.empty() || result.smoothing.inverted > 0));
  Numbers at_rest = rotor.at(0);
  CHECK(moving.follow(xy_points(at_rest)).is_valid());
}

}  // namespace trismooth::moving_quadrilaterals_test
