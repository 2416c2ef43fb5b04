// SPDX-License-Identifier: BSD-3-Clause
// Poisson's problem: -laplace(u) = f, u given on the boundary.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "comparison.h"
#include "linear_triangles.h"

namespace fem {

/// A solution that is known, to measure errors against.
struct KnownPotential {
  std::function<double(const Eigen::Vector2d&)> value;
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> gradient;
  std::function<double(const Eigen::Vector2d&)> source;  ///< f
};

/// u = sin(2 pi x) sin(3 pi y) + x.
inline KnownPotential waves() {
  constexpr double kx = 2 * std::numbers::pi;
  constexpr double ky = 3 * std::numbers::pi;
  return {[](const auto& p) { return std::sin(kx * p.x()) * std::sin(ky * p.y()) + p.x(); },
          [](const auto& p) {
            return Eigen::Vector2d(kx * std::cos(kx * p.x()) * std::sin(ky * p.y()) + 1,
                                   ky * std::sin(kx * p.x()) * std::cos(ky * p.y()));
          },
          [](const auto& p) { return (kx * kx + ky * ky) * std::sin(kx * p.x()) * std::sin(ky * p.y()); }};
}

/// Solves it with linear triangles. The errors are the L2 norms of u and of its gradient (the H1 seminorm).
inline Outcome solve_poisson(const Mesh& mesh, const KnownPotential& known, double tolerance = 1e-8) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(mesh.points.cols(), unknown);
  for (const BoundaryEdge& edge : boundary_edges(mesh)) {
    values[edge.a] = known.value(mesh.points.col(edge.a));
    values[edge.b] = known.value(mesh.points.col(edge.b));
  }

  Equations equations(std::move(values));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const LinearTriangle triangle(mesh, t);
    const std::array<int, 3> corners{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
    equations.add<3>(corners, triangle.area() * triangle.gradients().transpose() * triangle.gradients());
    triangle.integrate([&](double weight, const Eigen::Vector2d& place, const Eigen::Vector3d& functions) {
      const double source = known.source(place);
      for (int i = 0; i < 3; ++i) {
        equations.add_load(corners[i], weight * source * functions[i]);
      }
    });
  }

  Outcome outcome{equations.solve(tolerance)};
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const LinearTriangle triangle(mesh, t);
    const Eigen::Vector3d found = outcome.solution.values(mesh.triangles.col(t));
    const Eigen::Vector2d gradient = triangle.gradients() * found;
    triangle.integrate([&](double weight, const Eigen::Vector2d& place, const Eigen::Vector3d& functions) {
      outcome.value_error += weight * std::pow(found.dot(functions) - known.value(place), 2);
      outcome.gradient_error += weight * (gradient - known.gradient(place)).squaredNorm();
    });
  }
  outcome.value_error = std::sqrt(outcome.value_error);
  outcome.gradient_error = std::sqrt(outcome.gradient_error);
  return outcome;
}

}  // namespace fem
