// SPDX-License-Identifier: BSD-3-Clause
#include "finite_elements/plane_stress.h"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "catch.h"
#include "structured_meshes.h"

using fem::BoundaryEdge;
using fem::kirsch;
using fem::KnownDisplacement;
using fem::Material;
using fem::Outcome;
using fem::solve_plane_stress;

namespace {

const Material steel{210e3, 0.3};
constexpr std::array<double, 7> angles{0.1, 0.9, 1.8, 2.7, 3.6, 4.4, 5.5};

/// The strain (xx, yy, twice xy) of a displacement, by differences.
Eigen::Vector3d strain_of(const KnownDisplacement& known, const Eigen::Vector2d& place) {
  constexpr double step = 1e-5;
  const Eigen::Vector2d by_x =
      (known.value(place + Eigen::Vector2d(step, 0)) - known.value(place - Eigen::Vector2d(step, 0))) / (2 * step);
  const Eigen::Vector2d by_y =
      (known.value(place + Eigen::Vector2d(0, step)) - known.value(place - Eigen::Vector2d(0, step))) / (2 * step);
  return {by_x.x(), by_y.y(), by_x.y() + by_y.x()};
}

}  // namespace

TEST_CASE("patch test: a linear displacement is found exactly on a distorted mesh, also under loads") {
  const Eigen::Matrix2d slopes = (Eigen::Matrix2d() << 2e-3, -1e-3, 4e-3, 5e-4).finished();
  const Eigen::Vector3d stress = steel.stiffness() * Eigen::Vector3d(2e-3, 5e-4, 3e-3);
  const KnownDisplacement linear{[&](const auto& p) { return Eigen::Vector2d(slopes * p + Eigen::Vector2d(7e-3, 0)); },
                                 [&](const auto&) { return stress; }};
  const fem::Mesh mesh = structured::displaced_square(10, 0.2);
  const auto no_edge = [](const BoundaryEdge&) { return false; };
  const auto left_out = [&](const BoundaryEdge& edge) {
    return mesh.points.col(edge.a).x() > 0 || mesh.points.col(edge.b).x() > 0;
  };
  for (const std::function<bool(const BoundaryEdge&)>& loaded :
       {std::function<bool(const BoundaryEdge&)>(no_edge), std::function<bool(const BoundaryEdge&)>(left_out)}) {
    const Outcome outcome = solve_plane_stress(mesh, steel, linear, loaded, 1e-14);
    CHECK(outcome.value_error < 1e-10);
    CHECK(outcome.gradient_error < 1e-9);
  }
}

TEST_CASE("a bar under tension gets longer by F / (E A) and thinner by Poisson's ratio") {
  const KnownDisplacement tension{[](const auto& p) {
                                    return Eigen::Vector2d(100 / steel.young * p.x(),
                                                           -steel.poisson * 100 / steel.young * p.y());
                                  },
                                  [](const auto&) { return Eigen::Vector3d(100, 0, 0); }};
  const fem::Mesh mesh = structured::square(6);
  // Held at the left, pulled at the right, free above and below.
  const Outcome outcome = solve_plane_stress(
      mesh, steel, tension,
      [&](const BoundaryEdge& edge) { return mesh.points.col(edge.a).x() > 0 || mesh.points.col(edge.b).x() > 0; },
      1e-14);
  const Eigen::Index far_corner = mesh.points.cols() - 1;
  CHECK(outcome.solution.values[2 * far_corner] == Approx(100 / 210e3).epsilon(1e-9));
  CHECK(outcome.solution.values[2 * far_corner + 1] == Approx(-30 / 210e3).epsilon(1e-9));
}

TEST_CASE("Kirsch's plate: three times the tension above the hole, pressure beside it, a rim without load") {
  const Eigen::Vector2d centre(4, -2);
  const KnownDisplacement plate = kirsch(centre, 2, steel);
  CHECK((plate.stress(centre + Eigen::Vector2d(0, 2)) - Eigen::Vector3d(3, 0, 0)).norm() < 1e-12);
  CHECK((plate.stress(centre + Eigen::Vector2d(2, 0)) - Eigen::Vector3d(0, -1, 0)).norm() < 1e-12);
  CHECK((plate.stress(centre + Eigen::Vector2d(3e6, 2e6)) - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9);
  for (const double angle : angles) {
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const Eigen::Vector3d stress = plate.stress(centre + 2 * out);
    CHECK(std::abs(stress[0] * out.x() + stress[2] * out.y()) < 1e-12);
    CHECK(std::abs(stress[2] * out.x() + stress[1] * out.y()) < 1e-12);
  }
}

TEST_CASE("Kirsch's displacement has Kirsch's stress, which is in equilibrium") {
  const Eigen::Vector2d centre(4, -2);
  const KnownDisplacement plate = kirsch(centre, 2, steel);
  for (const double angle : angles) {
    const Eigen::Vector2d place = centre + (2 + angle) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector3d stress = plate.stress(place);
    CHECK((steel.stiffness() * strain_of(plate, place) - stress).norm() < 1e-7);
    constexpr double step = 1e-5;
    const Eigen::Vector3d by_x =
        (plate.stress(place + Eigen::Vector2d(step, 0)) - plate.stress(place - Eigen::Vector2d(step, 0))) / (2 * step);
    const Eigen::Vector3d by_y =
        (plate.stress(place + Eigen::Vector2d(0, step)) - plate.stress(place - Eigen::Vector2d(0, step))) / (2 * step);
    CHECK(std::abs(by_x[0] + by_y[2]) < 1e-8);
    CHECK(std::abs(by_x[2] + by_y[1]) < 1e-8);
  }
}

TEST_CASE("the plate's errors fall at the known rates: h^2 for the displacement, h for the energy norm") {
  const KnownDisplacement plate = kirsch({0, 0}, 1, steel);
  std::vector<Outcome> outcomes;
  for (const int n : {16, 32, 64}) {
    const fem::Mesh mesh = structured::ring(n);
    outcomes.push_back(solve_plane_stress(mesh, steel, plate, fem::on_rim(mesh, {0, 0}, 1)));
  }
  for (std::size_t i = 1; i < outcomes.size(); ++i) {
    CHECK(std::log2(outcomes[i - 1].value_error / outcomes[i].value_error) == Approx(2).margin(0.1));
    CHECK(std::log2(outcomes[i - 1].gradient_error / outcomes[i].gradient_error) == Approx(1).margin(0.1));
  }
}
