#include "trismooth/mesh_io/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "catch.h"

using trismooth::fit_plane;
using trismooth::Plane;
using trismooth::Point2;

namespace {

using Points = std::vector<Eigen::Vector3d>;

std::optional<Plane> plane_of(const Points& points) {
  std::vector<double> xyz;
  for (const Eigen::Vector3d& p : points) {
    xyz.insert(xyz.end(), {p.x(), p.y(), p.z()});
  }
  return fit_plane(xyz);
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

}  // namespace

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
  CHECK(fit_plane({}));
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
    line.push_back(size * (Eigen::Vector3d(1, 2, 3) + i * Eigen::Vector3d(0.3, -0.5, 0.7)));
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
