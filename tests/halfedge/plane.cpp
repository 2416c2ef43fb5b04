// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "trismooth/base/machine/workers.h"

#include "catch.h"

namespace trismooth::plane_test {

using Points = std::vector<Eigen::Vector3d>;

std::vector<double> flat(const Points& points) {
  std::vector<double> xyz;
  for (const Eigen::Vector3d& p : points) {
    xyz.insert(xyz.end(), {p.x(), p.y(), p.z()});
  }
  return xyz;
}

/// The plane of all points; nothing where they lie in none.
std::optional<Plane> plane_of(const Points& points, const CellList& cells = {}) {
  const PlaneFit fit = fit_plane(flat(points), std::vector<std::uint8_t>(points.size(), 1), cells);
  return fit.is_planar() ? std::optional(fit.plane) : std::nullopt;
}

/// A unit square of random points of the xy plane, its corners included, at height 0.
Points flat_points(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Points points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (int i = 0; i < 200; ++i) {
    points.emplace_back(unit(random), unit(random), 0);
  }
  return points;
}

Eigen::Matrix3d random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond rotation(normal(random), normal(random), normal(random), normal(random));
  return rotation.normalized().toRotationMatrix();
}

Points transformed(Points points, const Eigen::Matrix3d& matrix, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& p : points) {
    p = matrix * p + offset;
  }
  return points;
}

/// The largest difference between distances in space and in the plane, from the first point; in units of `size`.
double distortion(const Plane& plane, const Points& points, double size) {
  double largest = 0;
  const Point2<double> first = plane.project(points[0]);
  for (const Eigen::Vector3d& p : points) {
    const Point2<double> in_plane = plane.project(p);
    const double in_space = ((p - points[0]) / size).norm();
    largest = std::max(largest,
                       std::abs(in_space - std::hypot((in_plane.x - first.x) / size, (in_plane.y - first.y) / size)));
  }
  return largest;
}

TEST_CASE("a mesh along two coordinate axes keeps its coordinates as they are") {
  std::mt19937_64 random(1);
  const auto axes = GENERATE(std::array{0, 1}, std::array{0, 2}, std::array{1, 2});
  const double height = GENERATE(0.0, -0.1, 4e7);
  const int across = 3 - axes[0] - axes[1];
  Points points;
  for (const Eigen::Vector3d& p : flat_points(random)) {
    Eigen::Vector3d point;
    point[axes[0]] = p.x() + 0.1;
    point[axes[1]] = p.y() - 3;
    point[across] = height;
    points.push_back(point);
  }
  const auto plane = plane_of(points);
  REQUIRE(plane);
  CHECK(plane->aligned);
  CHECK(plane->axes == axes);
  for (const Eigen::Vector3d& p : points) {
    CHECK(plane->project(p) == Point2<double>{p[axes[0]], p[axes[1]]});
    const Eigen::Vector3d moved = plane->moved(p, plane->project(p), {0.7, 0.1});
    CHECK(moved[axes[0]] == 0.7);
    CHECK(moved[axes[1]] == 0.1);
    CHECK(moved[across] == height);
  }
}

TEST_CASE("a thin mesh lies in its own plane, not in one in which it is a line") {
  constexpr double thin = 1e-9;
  const auto axes = GENERATE(std::array{0, 1}, std::array{0, 2}, std::array{1, 2});
  const bool along_first = GENERATE(true, false);
  Points points;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Eigen::Vector3d point(3, 3, 3);
    point[axes[0]] = along_first ? x : x * thin;
    point[axes[1]] = along_first ? y * thin : y;
    points.push_back(point);
  }
  const auto plane = plane_of(points);
  REQUIRE(plane);
  CHECK(plane->aligned);
  CHECK(plane->axes == axes);
}

TEST_CASE("a tilted plane is found at any rotation, size and offset, and lengths in it are those of space") {
  std::mt19937_64 random(2);
  const double size = GENERATE(1.0, 1e200, 1e-200, 1e-9);
  for (int i = 0; i < 20; ++i) {
    const Points points =
        transformed(flat_points(random), size * random_rotation(random), size * Eigen::Vector3d(3, -2, 0.5));
    const auto plane = plane_of(points);
    REQUIRE(plane);
    CHECK_FALSE(plane->aligned);
    CHECK(plane->u.norm() == Approx(1).epsilon(1e-14));
    CHECK(plane->v.norm() == Approx(1).epsilon(1e-14));
    CHECK(std::abs(plane->u.dot(plane->v)) < 1e-14);
    CHECK(distortion(*plane, points, size) < 1e-13);
  }
}

TEST_CASE("a tilted plane far from the origin is found to the rounding of its coordinates") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const Points points = transformed(flat_points(random), 1000 * random_rotation(random), {4e7, -4e7, 4e7});
    const auto plane = plane_of(points);
    REQUIRE(plane);
    CHECK(distortion(*plane, points, 1000) < 1e-10);
  }
}

TEST_CASE("points that leave the plane by up to 1e-6 of the extent are planar, by 1e-4 not") {
  std::mt19937_64 random(4);
  const bool tilted = GENERATE(false, true);
  const double size = GENERATE(1.0, 1e200, 1e-200);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d matrix =
        size * (tilted ? random_rotation(random) : Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
    Points points = flat_points(random);
    points[50].z() = 0.4e-6;
    CHECK(plane_of(transformed(points, matrix, Eigen::Vector3d::Zero())));
    points[50].z() = 1e-4;
    CHECK_FALSE(plane_of(transformed(points, matrix, Eigen::Vector3d::Zero())));
  }
}

TEST_CASE("points that fill space are not planar") {
  CHECK_FALSE(plane_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  CHECK_FALSE(plane_of({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1e200}}));
  CHECK_FALSE(plane_of({{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}, {0, 0, 1e-200}}));
}

TEST_CASE("coordinates up to the end of the range of double are planar or not like any others") {
  const double huge = 1.7e308;
  const auto flat = plane_of({{-huge, -huge, 0}, {huge, -huge, 0}, {0, huge, 0}});
  REQUIRE(flat);
  CHECK(flat->aligned);
  CHECK_FALSE(plane_of({{-huge, -huge, -huge}, {huge, -huge, huge}, {0, huge, 0}, {huge, huge, -huge}}));
}

TEST_CASE("points on one line, equal points, one point and no point lie in a plane") {
  CHECK(plane_of({}));
  const double size = GENERATE(1.0, 1e200, 1e-200);
  const auto single = plane_of({size * Eigen::Vector3d(1, 2, 3)});
  REQUIRE(single);
  CHECK(single->aligned);
  CHECK(single->axes == std::array{0, 1});
  const auto equal = plane_of(Points(5, size * Eigen::Vector3d(1, 2, 3)));
  REQUIRE(equal);
  CHECK(equal->axes == std::array{0, 1});

  Points line;
  for (int i = 0; i <= 10; ++i) {
    line.emplace_back(size * (Eigen::Vector3d(1, 2, 3) + i * Eigen::Vector3d(0.3, -0.5, 0.7)));
  }
  const auto tilted = plane_of(line);
  REQUIRE(tilted);
  CHECK(distortion(*tilted, line, size) < 1e-13);
  const auto along_z = plane_of({{0, 0, 0}, {0, 0, size}, {0, 0, 2 * size}});
  REQUIRE(along_z);
  CHECK(along_z->axes == std::array{0, 2});
}

TEST_CASE("a point that does not move keeps its bits, one that does its offset from the plane") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 20; ++i) {
    Points points = flat_points(random);
    for (Eigen::Vector3d& p : points) {
      p.z() = 3e-7 * unit(random);
    }
    const double offset = i % 2 == 0 ? 0.0 : 1e5;
    points = transformed(points, random_rotation(random), Eigen::Vector3d::Constant(offset));
    const auto plane = plane_of(points);
    REQUIRE(plane);
    const Eigen::Vector3d normal = plane->u.cross(plane->v);
    const double rounding = 1e-15 * (1 + offset);
    for (const Eigen::Vector3d& p : points) {
      const Point2<double> from = plane->project(p);
      CHECK(plane->moved(p, from, from) == p);
      const Point2<double> to{from.x + unit(random), from.y + unit(random)};
      const Eigen::Vector3d moved = plane->moved(p, from, to);
      CHECK(std::abs(normal.dot(moved - p)) < 4 * rounding);
      CHECK(plane->project(moved).x == Approx(to.x).margin(10 * rounding));
      CHECK(plane->project(moved).y == Approx(to.y).margin(10 * rounding));
    }
  }
}

/// n x n vertices a unit apart, and the triangles between them.
struct Grid {
  Points points;
  CellList cells;
};

Grid unit_grid(std::int32_t n) {
  Grid grid;
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i < n; ++i) {
      grid.points.emplace_back(i, j, 0);
      const std::int32_t v = j * n + i;
      if (i + 1 < n && j + 1 < n) {
        grid.cells.append(trismooth::cell_type::triangle, std::vector{v, v + 1, v + n + 1});
        grid.cells.append(trismooth::cell_type::triangle, std::vector{v, v + n + 1, v + n});
      }
    }
  }
  return grid;
}

bool same_plane(const Plane& a, const Plane& b) {
  return a.aligned == b.aligned && a.axes == b.axes && a.slope == b.slope && a.origin == b.origin && a.u == b.u &&
         a.v == b.v && a.foot == b.foot && a.deviation == b.deviation;
}

TEST_CASE("points that do not count have no say in the plane, wherever they are") {
  std::mt19937_64 random(6);
  const double inclination = GENERATE(0.0, 1e-8, 0.7);
  const Eigen::Matrix3d matrix = Eigen::AngleAxisd(inclination, Eigen::Vector3d(0.6, 0.8, 0)).toRotationMatrix();
  const Points points = transformed(flat_points(random), matrix, Eigen::Vector3d::Zero());
  const auto expected = plane_of(points);
  REQUIRE(expected);
  for (const double far : {1e-5, 3e6, 1e154, 1.7e308}) {
    CAPTURE(far);
    Points more;
    std::vector<std::uint8_t> counts;
    for (const Eigen::Vector3d& p : points) {
      more.insert(more.end(), {Eigen::Vector3d(far, -far, 0.4 * far), p});
      counts.insert(counts.end(), {0, 1});
    }
    const PlaneFit fit = fit_plane(flat(more), counts, {});
    CHECK(fit.is_planar());
    CHECK(same_plane(fit.plane, *expected));
    Workers one(1);
    const auto in_plane = project(fit.plane, flat(more), counts, one);
    REQUIRE(in_plane);
    for (std::size_t v = 0; v < more.size(); ++v) {
      CHECK(std::isfinite((*in_plane)[v].x));
      CHECK((v % 2 == 0 || (*in_plane)[v] == expected->project(points[v / 2])));
    }
  }
}

TEST_CASE("small elements are held to the plane by their own size, not by an extent that a few large ones make") {
  Grid grid = unit_grid(8);
  const auto far = static_cast<std::int32_t>(grid.points.size());
  grid.points.emplace_back(3e6, 3.5, 0);
  for (std::int32_t j = 0; j < 7; ++j) {
    grid.cells.append(trismooth::cell_type::triangle, std::vector{8 * j + 7, far, 8 * j + 15});
  }
  for (const double height : {0.0, 0.01, 0.05}) {
    grid.points[27].z() = height;
    CHECK(plane_of(grid.points, grid.cells));
  }
  for (const double height : {0.3, 1.0}) {
    grid.points[27].z() = height;
    CAPTURE(height);
    const PlaneFit fit = fit_plane(flat(grid.points), std::vector<std::uint8_t>(grid.points.size(), 1), grid.cells);
    CHECK(fit.outside == 27);
    CHECK(fit.distance == Approx(height).epsilon(0.1));
    CHECK(fit.fault().find("the mesh is not planar: vertex 27 is ") == 0);
  }
  // A cell of no extent at all says nothing of size.
  grid.points[27].z() = 0.05;
  grid.cells.append(trismooth::cell_type::line, std::vector{27, 27});
  CHECK(plane_of(grid.points, grid.cells));
}

TEST_CASE("a narrow mesh of any length is in the plane in which its cross-section lies") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double length : {1e3, 1.2e7, 1e12}) {
    CAPTURE(length);
    Points points{{length, 2.5, 2.5}};
    for (int i = 0; i < 40; ++i) {
      const double y = 5 * unit(random);
      points.emplace_back(5 * unit(random), y, y);
    }
    const auto plane = plane_of(points);
    REQUIRE(plane);
    CHECK_FALSE(plane->aligned);
    CHECK(std::abs(plane->normal().dot(Eigen::Vector3d(0, 1, 1).normalized())) < 1e-9);
    CHECK(std::abs(plane->normal().x()) < 1e-9 / length);
  }
}

TEST_CASE("what moves in a plane that is inclined a little rises with it, its coordinates along the axes untouched") {
  std::mt19937_64 random(8);
  const auto axes = GENERATE(std::array{0, 1}, std::array{0, 2}, std::array{1, 2});
  const double slope = GENERATE(1e-9, -7e-7);
  const int across = 3 - axes[0] - axes[1];
  Points points;
  for (const Eigen::Vector3d& p : flat_points(random)) {
    Eigen::Vector3d point;
    point[axes[0]] = p.x();
    point[axes[1]] = p.y();
    point[across] = slope * p.x() - 0.3 * slope * p.y();
    points.push_back(point);
  }
  const auto plane = plane_of(points);
  REQUIRE(plane);
  CHECK(plane->aligned);
  const Eigen::Vector3d& p = points[7];
  const Eigen::Vector3d moved = plane->moved(p, plane->project(p), {0.7, 0.1});
  CHECK(moved[axes[0]] == 0.7);
  CHECK(moved[axes[1]] == 0.1);
  CHECK(std::abs(moved[across] - slope * (0.7 - 0.03)) < 1e-16);
}

TEST_CASE("noise across a plane of two axes is no slope: the third coordinate keeps its bits") {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> noise(-1, 1);
  const double size = GENERATE(1e-16, 1e-9, 4e-7);
  Points points = flat_points(random);
  for (Eigen::Vector3d& p : points) {
    p.z() = 0.1 + size * noise(random);
  }
  const auto plane = plane_of(points);
  REQUIRE(plane);
  CHECK(plane->aligned);
  CHECK(plane->moved(points[9], plane->project(points[9]), {0.7, 0.1}).z() == points[9].z());
}

TEST_CASE("the plane of the fixed points is seen from the side that the plane before was") {
  const Grid flat_grid = unit_grid(12);
  int settled_planes = 0;
  for (int i = 0; i < 200; ++i) {
    // Far from the origin, where rounding to float32 makes two fits differ.
    const Eigen::Vector3d axis = Eigen::Vector3d(std::sin(i), std::cos(3 * i), std::sin(2 * i + 1)).normalized();
    const Eigen::AngleAxisd turn(0.3 + 0.1 * (i % 29), axis);
    std::vector<Eigen::Vector3d> points;
    std::vector<std::uint8_t> fixed;
    for (const Eigen::Vector3d& point : flat_grid.points) {
      const Eigen::Vector3d placed = turn * point + Eigen::Vector3d(30, -20, 10) * (1 + i % 40);
      points.emplace_back(placed.cast<float>().cast<double>());
      const bool inside = point.x() > 0 && point.x() < 11 && point.y() > 0 && point.y() < 11;
      fixed.push_back(inside ? 0 : 1);
    }
    const std::vector<std::uint8_t> all(points.size(), 1);
    const auto fit = trismooth::fit_plane(flat(points), all, {}, trismooth::Storage::float32);
    const auto settled = plane_of_fixed(fit.plane, flat(points), all, fixed, trismooth::Storage::float32);
    if (!settled || !settled->is_planar()) {
      continue;
    }
    ++settled_planes;
    const auto doubled_area = [&](const Plane& plane) {
      const auto a = plane.project(points[0]);
      return trismooth::cross(plane.project(points[11]) - a, plane.project(points.back()) - a);
    };
    CAPTURE(i);
    CHECK(doubled_area(fit.plane) * doubled_area(settled->plane) > 0);
  }
  CHECK(settled_planes > 20);
}

TEST_CASE("where free vertices far away hide that the fixed ones are in another plane, theirs is taken, or none") {
  Grid grid = unit_grid(4);
  std::vector<std::uint8_t> fixed(16, 1);
  for (const std::size_t inner : {5, 6, 9, 10}) {
    fixed[inner] = 0;
  }
  const std::vector<std::uint8_t> all(16, 1);
  grid.points[5] = {1114, 0, 0.1};
  const auto seeming = plane_of(grid.points, grid.cells);
  REQUIRE(seeming);
  const auto settled = plane_of_fixed(*seeming, flat(grid.points), all, fixed);
  REQUIRE(settled);
  REQUIRE(settled->is_planar());
  const Plane& plane = settled->plane;
  CHECK(plane.aligned);
  CHECK(plane.moved(grid.points[5], plane.project(grid.points[5]), {1, 1}) == Eigen::Vector3d(1, 1, 0));
  CHECK(plane.moved(grid.points[5], plane.project(grid.points[5]), {1114, 0}) == grid.points[5]);

  grid.points[3].z() = 1e-4;
  CHECK_FALSE(plane_of_fixed(*seeming, flat(grid.points), all, fixed)->is_planar());
  grid.points[3].z() = 0;
  CHECK_FALSE(plane_of_fixed(*plane_of(unit_grid(4).points), flat(unit_grid(4).points), all, fixed));
  // Nothing but a line is fixed, or nothing at all: the plane stays, and what moves comes to lie in it.
  std::vector<std::uint8_t> line(16, 0);
  line[0] = line[1] = line[2] = 1;
  for (const auto& few : {line, std::vector<std::uint8_t>(16, 0)}) {
    const auto kept = plane_of_fixed(*seeming, flat(grid.points), all, few);
    REQUIRE(kept);
    CHECK(kept->plane.drops_offsets);
    CHECK(kept->plane.u == seeming->u);
    const Eigen::Vector3d moved = kept->plane.moved(grid.points[6], kept->plane.project(grid.points[6]), {1, 1});
    CHECK(std::abs(kept->plane.normal().dot(moved - kept->plane.foot)) < 1e-12);
  }
}

}  // namespace trismooth::plane_test
