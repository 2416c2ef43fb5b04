// SPDX-License-Identifier: BSD-3-Clause
#include "finite_elements/linear_triangles.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "catch.h"
#include "structured_meshes.h"

using fem::Equations;
using fem::LinearTriangle;
using fem::Mesh;

namespace {

Mesh one_triangle(int first, int second, int third) {
  Mesh mesh;
  mesh.points.resize(2, 3);
  mesh.points << 0, 2, 0, 0, 0, 3;
  mesh.triangles.resize(3, 1);
  mesh.triangles << first, second, third;
  return mesh;
}

double factorial(int n) {
  return std::tgamma(n + 1);
}

}  // namespace

TEST_CASE("integrals over a triangle are exact for polynomials of degree 8, however it is listed") {
  for (const Mesh& mesh : {one_triangle(0, 1, 2), one_triangle(2, 1, 0), one_triangle(1, 0, 2)}) {
    const LinearTriangle triangle(mesh, 0);
    CHECK(triangle.area() == Approx(3).epsilon(1e-14));
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; i + j <= 8; ++j) {
        double found = 0;
        triangle.integrate([&](double weight, const Eigen::Vector2d& place, const Eigen::Vector3d&) {
          found += weight * std::pow(place.x(), i) * std::pow(place.y(), j);
        });
        const double exact =
            std::pow(2, i + 1) * std::pow(3, j + 1) * factorial(i) * factorial(j) / factorial(i + j + 2);
        CHECK(found == Approx(exact).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("a triangle's functions are 1 at their corner, add up to 1, and have the gradients that are said") {
  const Mesh mesh = one_triangle(0, 2, 1);
  const LinearTriangle triangle(mesh, 0);
  CHECK((triangle.gradients() * Eigen::Vector3d::Ones()).norm() < 1e-15);
  // 5 x - 7 y at the corners.
  const Eigen::Vector3d values(0, -21, 10);
  CHECK((triangle.gradients() * values - Eigen::Vector2d(5, -7)).norm() < 1e-13);
  triangle.integrate([&](double, const Eigen::Vector2d& place, const Eigen::Vector3d& functions) {
    CHECK(functions.sum() == Approx(1).epsilon(1e-14));
    CHECK(functions.dot(values) == Approx(5 * place.x() - 7 * place.y()).epsilon(1e-12));
  });
}

TEST_CASE("the boundary of a ring is its two circles, each edge with the vertex behind it") {
  const int n = 5;
  const Mesh mesh = structured::ring(n);
  const std::vector<fem::BoundaryEdge> boundary = boundary_edges(mesh);
  CHECK(boundary.size() == 8 * n);
  for (const fem::BoundaryEdge& edge : boundary) {
    const double radius = mesh.points.col(edge.a).norm();
    CHECK((std::abs(radius - 1) < 1e-12 || std::abs(radius - 3) < 1e-12));
    CHECK(mesh.points.col(edge.b).norm() == Approx(radius));
    CHECK(std::abs(mesh.points.col(edge.opposite).norm() - radius) > 0.1);
  }
}

TEST_CASE("the rim of a hole is the edges of the boundary on its circle") {
  const fem::Mesh mesh = structured::ring(6);
  const auto inner = fem::on_rim(mesh, {0, 0}, 1);
  int on_inner = 0;
  for (const fem::BoundaryEdge& edge : boundary_edges(mesh)) {
    on_inner += inner(edge) ? 1 : 0;
    CHECK(inner(edge) == (mesh.points.col(edge.a).norm() < 2));
  }
  CHECK(on_inner == 24);
  CHECK_THROWS_AS(fem::on_rim(mesh, {0, 0}, 2), std::runtime_error);
  CHECK_THROWS_AS(fem::on_rim(mesh, {0.5, 0}, 1), std::runtime_error);
}

TEST_CASE("what is prescribed stays, and the rest is what elimination gives") {
  // 4 x - y = 1, -x + 3 y - z = 2 with z = 5.
  Equations equations(Eigen::Vector3d(fem::unknown, fem::unknown, 5));
  Eigen::Matrix3d matrix;
  matrix << 4, -1, 0, -1, 3, -1, 0, -1, 9;
  equations.add<3>({0, 1, 2}, matrix);
  equations.add_load(0, 1);
  equations.add_load(1, 2);
  equations.add_load(2, 1e6);
  const fem::Solution solution = equations.solve(1e-14);
  CHECK(solution.values[0] == Approx(10.0 / 11).epsilon(1e-12));
  CHECK(solution.values[1] == Approx(29.0 / 11).epsilon(1e-12));
  CHECK(solution.values[2] == 5);
  CHECK(solution.plain == 2);
}

TEST_CASE(
    "plain conjugate gradients take an iteration for each eigenvalue, and Jacobi solves a diagonal matrix at once") {
  Equations equations(Eigen::VectorXd::Constant(9, fem::unknown));
  for (int i = 0; i < 9; ++i) {
    equations.add<1>({i}, Eigen::Matrix<double, 1, 1>(1 + i % 3));
    equations.add_load(i, 1);
  }
  const fem::Solution solution = equations.solve(1e-10);
  CHECK(solution.plain == 3);
  CHECK(solution.jacobi == 1);
}
