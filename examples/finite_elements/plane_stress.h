// SPDX-License-Identifier: BSD-3-Clause
// Plane stress: a plate that is pulled in x, with a round hole (Kirsch 1898).
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "comparison.h"
#include "linear_triangles.h"

namespace fem {

/// Steel's ratio; stresses and strains are in units of Young's modulus.
struct Material {
  double young = 1;
  double poisson = 0.3;

  /// Stress (xx, yy, xy) of strain (xx, yy, twice xy).
  Eigen::Matrix3d stiffness() const {
    Eigen::Matrix3d matrix;
    matrix << 1, poisson, 0, poisson, 1, 0, 0, 0, (1 - poisson) / 2;
    return young / (1 - poisson * poisson) * matrix;
  }
};

/// A solution without volume forces that is known, to measure errors against.
struct KnownDisplacement {
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> value;
  std::function<Eigen::Vector3d(const Eigen::Vector2d&)> stress;  ///< xx, yy, xy
};

/// The infinite plate under a tension of 1 in x far from the hole.
inline KnownDisplacement kirsch(const Eigen::Vector2d& centre, double radius, const Material& material) {
  const double shear = material.young / (2 * (1 + material.poisson));
  const double kappa = (3 - material.poisson) / (1 + material.poisson);
  const auto polar = [=](const Eigen::Vector2d& p) {
    const Eigen::Vector2d from = p - centre;
    return std::pair(from.norm() / radius, std::atan2(from.y(), from.x()));
  };
  return {[=](const Eigen::Vector2d& p) {
            const auto [r, angle] = polar(p);
            const double x = r * (kappa + 1) * std::cos(angle) +
                             2 / r * ((1 + kappa) * std::cos(angle) + std::cos(3 * angle)) -
                             2 / (r * r * r) * std::cos(3 * angle);
            const double y = r * (kappa - 3) * std::sin(angle) +
                             2 / r * ((1 - kappa) * std::sin(angle) + std::sin(3 * angle)) -
                             2 / (r * r * r) * std::sin(3 * angle);
            return Eigen::Vector2d(radius / (8 * shear) * Eigen::Vector2d(x, y));
          },
          [=](const Eigen::Vector2d& p) {
            const auto [r, angle] = polar(p);
            const double r2 = 1 / (r * r);
            const double r4 = 1.5 * r2 * r2;
            return Eigen::Vector3d(
                1 - r2 * (1.5 * std::cos(2 * angle) + std::cos(4 * angle)) + r4 * std::cos(4 * angle),
                -r2 * (0.5 * std::cos(2 * angle) - std::cos(4 * angle)) - r4 * std::cos(4 * angle),
                -r2 * (0.5 * std::sin(2 * angle) + std::sin(4 * angle)) + r4 * std::sin(4 * angle));
          }};
}

/// The strain (xx, yy, twice xy) of a triangle from the displacements of its corners (x and y of each).
inline Eigen::Matrix<double, 3, 6> strain_matrix(const LinearTriangle& triangle) {
  Eigen::Matrix<double, 3, 6> matrix;
  for (int i = 0; i < 3; ++i) {
    const double x = triangle.gradients()(0, i);
    const double y = triangle.gradients()(1, i);
    matrix.block<3, 2>(0, 2 * i) << x, 0, 0, y, y, x;
  }
  return matrix;
}

/// Loads an edge with the known stress.
inline void add_edge_load(Equations& equations, const Mesh& mesh, const BoundaryEdge& edge,
                          const KnownDisplacement& known) {
  const Eigen::Vector2d from = mesh.points.col(edge.a);
  const Eigen::Vector2d along = mesh.points.col(edge.b) - from;
  Eigen::Vector2d normal(along.y(), -along.x());  // as long as the edge, away from the triangle
  normal *= normal.dot(mesh.points.col(edge.opposite) - from) > 0 ? -1 : 1;
  for (const auto& [t, weight] : gauss_points) {
    const Eigen::Vector3d stress = known.stress(from + t * along);
    const Eigen::Vector2d load(stress[0] * normal.x() + stress[2] * normal.y(),
                               stress[2] * normal.x() + stress[1] * normal.y());
    for (int axis = 0; axis < 2; ++axis) {
      equations.add_load(2 * edge.a + axis, weight * (1 - t) * load[axis]);
      equations.add_load(2 * edge.b + axis, weight * t * load[axis]);
    }
  }
}

/// Solves it with linear triangles. Edges of the boundary that are `loaded` have the known stress, the others the known
/// displacement. The errors are parts of the known solution's: the L2 norm of the displacement, and the energy norm.
inline Outcome solve_plane_stress(const Mesh& mesh, const Material& material, const KnownDisplacement& known,
                                  const std::function<bool(const BoundaryEdge&)>& loaded, double tolerance = 1e-8) {
  const std::vector<BoundaryEdge> boundary = boundary_edges(mesh);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(2 * mesh.points.cols(), unknown);  // x and y of every vertex
  for (const BoundaryEdge& edge : boundary) {
    if (!loaded(edge)) {
      values.segment<2>(2 * edge.a) = known.value(mesh.points.col(edge.a));
      values.segment<2>(2 * edge.b) = known.value(mesh.points.col(edge.b));
    }
  }

  Equations equations(std::move(values));
  const Eigen::Matrix3d stiffness = material.stiffness();
  const auto places = [&](Eigen::Index triangle) {
    const auto corners = mesh.triangles.col(triangle);
    return std::array<int, 6>{2 * corners[0],     2 * corners[0] + 1, 2 * corners[1],
                              2 * corners[1] + 1, 2 * corners[2],     2 * corners[2] + 1};
  };
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const LinearTriangle triangle(mesh, t);
    const Eigen::Matrix<double, 3, 6> strain = strain_matrix(triangle);
    equations.add<6>(places(t), triangle.area() * strain.transpose() * stiffness * strain);
  }
  for (const BoundaryEdge& edge : boundary) {
    if (loaded(edge)) {
      add_edge_load(equations, mesh, edge, known);
    }
  }

  Outcome outcome{equations.solve(tolerance)};
  const Eigen::Matrix3d compliance = stiffness.inverse();
  double size = 0;
  double energy = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const LinearTriangle triangle(mesh, t);
    const Eigen::Matrix<double, 6, 1> found = outcome.solution.values(places(t));
    const Eigen::Vector3d stress = stiffness * strain_matrix(triangle) * found;
    triangle.integrate([&](double weight, const Eigen::Vector2d& place, const Eigen::Vector3d& functions) {
      const Eigen::Vector2d exact = known.value(place);
      const Eigen::Vector3d exact_stress = known.stress(place);
      const Eigen::Vector3d stress_error = stress - exact_stress;
      outcome.value_error += weight * (found.reshaped(2, 3) * functions - exact).squaredNorm();
      outcome.gradient_error += weight * stress_error.dot(compliance * stress_error);
      size += weight * exact.squaredNorm();
      energy += weight * exact_stress.dot(compliance * exact_stress);
    });
  }
  outcome.value_error = std::sqrt(outcome.value_error / size);
  outcome.gradient_error = std::sqrt(outcome.gradient_error / energy);
  return outcome;
}

}  // namespace fem
