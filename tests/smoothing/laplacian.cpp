#include "trismooth/smoothing/methods/laplacian.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/naive_smoothing.h"
#include "support/random_rings.h"

namespace trismooth::laplacian_test {

/// Where every free vertex is the mean of its neighbours: the solution of the linear system, x and y.
std::vector<double> harmonic_positions(const test_meshes::Mesh& mesh) {
  const naive::Rings rings = naive::one_rings(mesh.vertex_count(), mesh.triangles);
  std::vector<Eigen::Index> unknown(rings.size(), -1);
  Eigen::Index count = 0;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (!rings[v].empty()) {
      unknown[v] = count++;
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d sides = Eigen::MatrixX2d::Zero(count, 2);
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (unknown[v] < 0) {
      continue;
    }
    entries.emplace_back(unknown[v], unknown[v], static_cast<double>(rings[v].size()));
    for (const std::int32_t neighbour : rings[v]) {
      if (unknown[neighbour] >= 0) {
        entries.emplace_back(unknown[v], unknown[neighbour], -1.0);
      } else {
        sides.row(unknown[v]) += Eigen::RowVector2d(mesh.points[neighbour].x, mesh.points[neighbour].y);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  const Eigen::MatrixX2d solution = factors.solve(sides);
  std::vector<double> xy = mesh.xy();
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (unknown[v] >= 0) {
      xy[2 * v] = solution(unknown[v], 0);
      xy[2 * v + 1] = solution(unknown[v], 1);
    }
  }
  return xy;
}

TEMPLATE_TEST_CASE("a vertex moves to the mean of its neighbours, whatever that does", "", float, double) {
  test_meshes::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto ring = random_rings::any<TestType>(random);
    const Point2<TestType> here{static_cast<TestType>(random.between(-1, 1)),
                                static_cast<TestType>(random.between(-1, 1))};
    const auto move = Laplacian::update<TestType>(here, ring);
    REQUIRE(move.moved);
    REQUIRE(move.position == naive::laplacian(ring.positions));
    REQUIRE_FALSE(Laplacian::update<TestType>(move.position, ring).moved);
  }
}

TEST_CASE("plain Laplacian smoothing converges to the solution of its linear system") {
  // About 1000 vertices; the sides of the square are convex, so the solution is a valid mesh.
  for (const auto& mesh : {test_meshes::shuffled(test_meshes::jittered_grid(32, 32, 0.4, 1), 2),
                           test_meshes::shuffled(test_meshes::tangled(32, 3), 4)}) {
    const std::vector<double> expected = harmonic_positions(mesh);
    for (const Form form : {Form::swap, Form::in_place}) {
      CAPTURE(form);
      SmoothingOptions options;
      options.method = trismooth::Method::laplacian;
      options.form = form;
      options.guard = false;
      options.tolerance = 1e-12;
      options.max_sweeps = 0;
      std::vector<double> xy = mesh.xy();
      const auto result = trismooth::smooth(trismooth::xy_points(xy), mesh.indices(), {}, options);
      CHECK(result.stop_reason == StopReason::tolerance);
      double largest_error = 0;
      for (std::size_t i = 0; i < xy.size(); ++i) {
        largest_error = std::max(largest_error, std::abs(xy[i] - expected[i]));
      }
      CHECK(largest_error < 1e-8);
    }
  }
}

}  // namespace trismooth::laplacian_test
