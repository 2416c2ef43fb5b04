// SPDX-License-Identifier: BSD-3-Clause
#include "finite_elements/poisson.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "catch.h"
#include "structured_meshes.h"

using fem::Outcome;
using fem::solve_poisson;
using fem::waves;

TEST_CASE("Poisson's errors fall at the known rates: h^2, and h for the gradient") {
  std::vector<Outcome> outcomes;
  for (const int n : {16, 32, 64, 128}) {
    outcomes.push_back(solve_poisson(structured::square(n), waves()));
  }
  for (std::size_t i = 1; i < outcomes.size(); ++i) {
    const double slack = std::pow(2, -static_cast<double>(i)) * 0.2;
    CHECK(std::log2(outcomes[i - 1].value_error / outcomes[i].value_error) == Approx(2).margin(slack));
    CHECK(std::log2(outcomes[i - 1].gradient_error / outcomes[i].gradient_error) == Approx(1).margin(slack));
  }
}

TEST_CASE("a linear solution is found exactly on a distorted mesh") {
  const fem::KnownPotential linear{[](const auto& p) { return 3 - 2 * p.x() + 5 * p.y(); },
                                   [](const auto&) { return Eigen::Vector2d(-2, 5); }, [](const auto&) { return 0.0; }};
  const Outcome outcome = solve_poisson(structured::displaced_square(12, 0.2), linear, 1e-14);
  CHECK(outcome.value_error < 1e-12);
  CHECK(outcome.gradient_error < 1e-11);
}

TEST_CASE("a quadratic solution is exact at the vertices of a grid, as the five-point formula is") {
  const fem::KnownPotential quadratic{[](const auto& p) { return p.squaredNorm(); },
                                      [](const auto& p) { return Eigen::Vector2d(2 * p); },
                                      [](const auto&) { return -4.0; }};
  const fem::Mesh mesh = structured::square(8);
  const Outcome outcome = solve_poisson(mesh, quadratic, 1e-14);
  for (Eigen::Index v = 0; v < mesh.points.cols(); ++v) {
    CHECK(outcome.solution.values[v] == Approx(mesh.points.col(v).squaredNorm()).margin(1e-12));
  }
}

TEST_CASE(
    "the gradient's error is what the solution's energy lacks of the exact one, so its integrals are good enough") {
  // On the square's sides the exact solution is x, so the error is orthogonal to what was found. Its energy is known.
  constexpr double exact = 13 * std::numbers::pi * std::numbers::pi / 4 + 1;
  for (const int n : {6, 10, 40}) {
    const fem::Mesh mesh = structured::displaced_square(n, 0.2);
    const Outcome outcome = solve_poisson(mesh, waves(), 1e-14);
    double energy = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
      const fem::LinearTriangle triangle(mesh, t);
      const Eigen::Vector3d values = outcome.solution.values(mesh.triangles.col(t));
      energy += triangle.area() * (triangle.gradients() * values).squaredNorm();
    }
    CHECK(outcome.gradient_error == Approx(std::sqrt(exact - energy)).epsilon(1e-6));
  }
}
