// SPDX-License-Identifier: BSD-3-Clause
// What both problems need: a mesh in Eigen's matrices, linear triangles, and equations solved by conjugate gradients.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <Eigen/SparseCore>

namespace fem {

/// A mesh in the plane, as the library takes it: nothing is copied on the way there.
struct Mesh {
  Eigen::Matrix2Xd points;            ///< a column for every vertex, each used by a triangle
  Eigen::Matrix3Xi triangles;         ///< a column of vertex numbers for every triangle, listed in either direction
  std::vector<std::int32_t> regions;  ///< one number a triangle; empty: all are of one region
};

/// An edge of the boundary and the vertex opposite to it.
struct BoundaryEdge {
  int a = 0;
  int b = 0;
  int opposite = 0;
};

/// The edges that one triangle has and no other.
inline std::vector<BoundaryEdge> boundary_edges(const Mesh& mesh) {
  std::map<std::pair<int, int>, std::pair<int, BoundaryEdge>> edges;
  for (const auto& triangle : mesh.triangles.colwise()) {
    for (int i = 0; i < 3; ++i) {
      const BoundaryEdge edge{triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]};
      auto& [count, last] = edges[std::minmax(edge.a, edge.b)];
      ++count;
      last = edge;
    }
  }
  std::vector<BoundaryEdge> boundary;
  for (const auto& [ends, counted] : edges) {
    if (counted.first == 1) {
      boundary.push_back(counted.second);
    }
  }
  return boundary;
}

/// Whether an edge of the mesh's boundary lies on the rim of a round hole. Throws std::runtime_error where none does.
inline std::function<bool(const BoundaryEdge&)> on_rim(const Mesh& mesh, const Eigen::Vector2d& centre, double radius) {
  auto on_circle = [points = mesh.points, centre, radius](const BoundaryEdge& edge) {
    const auto distance = [&](int v) { return (points.col(v) - centre).norm(); };
    return std::max(std::abs(distance(edge.a) - radius), std::abs(distance(edge.b) - radius)) < 1e-3 * radius;
  };
  const std::vector<BoundaryEdge> boundary = boundary_edges(mesh);
  if (std::none_of(boundary.begin(), boundary.end(), on_circle)) {
    throw std::runtime_error("the mesh has no hole of that centre and radius");
  }
  return on_circle;
}

/// Gauss-Legendre's five points of [0, 1] and their weights: exact for polynomials of degree 9.
inline constexpr std::array<std::pair<double, double>, 5> gauss_points{{{0.046910077030668004, 0.11846344252809454},
                                                                        {0.23076534494715845, 0.23931433524968324},
                                                                        {0.5, 0.28444444444444444},
                                                                        {0.76923465505284155, 0.23931433524968324},
                                                                        {0.953089922969332, 0.11846344252809454}}};

/// A triangle with one linear function for each corner, which is 1 there and 0 at the other two.
class LinearTriangle {
 public:
  LinearTriangle(const Mesh& mesh, Eigen::Index triangle) {
    for (int i = 0; i < 3; ++i) {
      corners_.col(i) = mesh.points.col(mesh.triangles(i, triangle));
    }
    Eigen::Matrix2d edges;
    edges << corners_.col(1) - corners_.col(0), corners_.col(2) - corners_.col(0);
    area_ = std::abs(edges.determinant()) / 2;
    gradients_.rightCols<2>() = edges.inverse().transpose();
    gradients_.col(0) = -gradients_.col(1) - gradients_.col(2);
  }

  double area() const { return area_; }
  /// A column for each corner's function; the same everywhere in the triangle.
  const Eigen::Matrix<double, 2, 3>& gradients() const { return gradients_; }

  /// Calls function(weight, place, values of the three functions there) for 25 points: the sum of weight times value is
  /// the integral, exactly for polynomials of degree 8.
  template <class Function>
  void integrate(const Function& function) const {
    for (const auto& [s, weight_s] : gauss_points) {
      for (const auto& [t, weight_t] : gauss_points) {
        const Eigen::Vector3d values(1 - s, s * (1 - t), s * t);
        function(2 * area_ * s * weight_s * weight_t, Eigen::Vector2d(corners_ * values), values);
      }
    }
  }

 private:
  Eigen::Matrix<double, 2, 3> corners_;
  Eigen::Matrix<double, 2, 3> gradients_;
  double area_ = 0;
};

/// Marks an unknown of Equations.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Solution {
  Eigen::VectorXd values;   ///< what was prescribed, and what was solved for
  Eigen::Index plain = 0;   ///< iterations of conjugate gradients
  Eigen::Index jacobi = 0;  ///< the same, divided by the matrix's diagonal first
};

/// Symmetric linear equations, summed up element by element. What is prescribed is eliminated.
class Equations {
 public:
  /// A number for everything prescribed, `unknown` for what is to be found.
  explicit Equations(Eigen::VectorXd values) : values_(std::move(values)), row_(values_.size(), -1) {
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      row_[i] = std::isnan(values_[i]) ? rows_++ : -1;
    }
    right_side_ = Eigen::VectorXd::Zero(rows_);
  }

  /// Adds an element's matrix; row and column i belong to number places[i].
  template <std::size_t N>
  void add(const std::array<int, N>& places, const Eigen::Matrix<double, N, N>& stiffness) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N && row_[places[i]] >= 0; ++j) {
        if (row_[places[j]] >= 0) {
          entries_.emplace_back(row_[places[i]], row_[places[j]], stiffness(i, j));
        } else {
          right_side_[row_[places[i]]] -= stiffness(i, j) * values_[places[j]];
        }
      }
    }
  }

  /// Adds to the right side of what belongs to number `place`.
  void add_load(int place, double load) {
    if (row_[place] >= 0) {
      right_side_[row_[place]] += load;
    }
  }

  /// Solves to `tolerance` times the length of the right side, from zeros.
  Solution solve(double tolerance) const {
    Eigen::SparseMatrix<double> matrix(rows_, rows_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const auto run = [&](auto solver) {
      solver.setTolerance(tolerance);
      solver.setMaxIterations(20 * rows_ + 100);
      solver.compute(matrix);
      Eigen::VectorXd found = solver.solve(right_side_);
      if (solver.info() != Eigen::Success) {
        throw std::runtime_error("conjugate gradients do not converge");
      }
      return std::pair(std::move(found), solver.iterations() + 1);  // Eigen does not count the last one
    };
    using Matrix = Eigen::SparseMatrix<double>;
    constexpr int whole = Eigen::Lower | Eigen::Upper;
    Solution solution{values_};
    solution.plain = run(Eigen::ConjugateGradient<Matrix, whole, Eigen::IdentityPreconditioner>()).second;
    const auto [found, iterations] = run(Eigen::ConjugateGradient<Matrix, whole>());
    solution.jacobi = iterations;
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      if (row_[i] >= 0) {
        solution.values[i] = found[row_[i]];
      }
    }
    return solution;
  }

 private:
  Eigen::VectorXd values_;
  std::vector<int> row_;  // of each number in the matrix; -1: prescribed
  int rows_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_side_;
};

}  // namespace fem
