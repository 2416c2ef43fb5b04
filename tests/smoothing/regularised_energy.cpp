// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/regularised_energy.h"

#include <array>
#include <cmath>
#include <utility>

#include "trismooth/quality/triangle_quality.h"

#include "catch.h"
#include "support/test_meshes.h"

namespace trismooth::regularised_energy_test {

/// e and t, as the energy has them.
struct Coordinates {
  std::array<double, 4> values;

  /// The triangle around the origin with these coordinates. `height`: of the ideal one over its base.
  RegularisedEnergy::Shape shape(double target, const IdealTriangle& ideal, double height) const {
    const auto [ex, ey, tx, ty] = values;
    // t = h J (z1 - z2), so z1 - z2 = -1/h J t; z1 + z2 = -e times 2/3 where the sum of all is 0.
    const Point2<double> d{ty / height, -tx / height};
    const Point2<double> z0{ex * 2 / 3, ey * 2 / 3};
    const Point2<double> z1{-0.5 * z0.x + 0.5 * d.x, -0.5 * z0.y + 0.5 * d.y};
    const Point2<double> z2{-0.5 * z0.x - 0.5 * d.x, -0.5 * z0.y - 0.5 * d.y};
    return RegularisedEnergy::shape_of(z0, z1, z2, target, ideal);
  }
};

/// A kind of ideal triangle with the height of it over its base, and the size that is aimed at.
struct Aim {
  const IdealTriangle* ideal;
  double height;
  double target;

  RegularisedEnergy::Shape shape(const Coordinates& at) const { return at.shape(target, *ideal, height); }
};

using Matrix = std::array<std::array<double, 4>, 4>;

Matrix hessian_of(const RegularisedEnergy::Derivatives& d) {
  return {{{d.ee[0], d.ee[1], d.et[0], d.et[1]},
           {d.ee[1], d.ee[2], d.et[2], d.et[3]},
           {d.et[0], d.et[2], d.tt[0], d.tt[1]},
           {d.et[1], d.et[3], d.tt[1], d.tt[2]}}};
}

std::array<double, 4> gradient_of(const RegularisedEnergy::Derivatives& d) {
  return {d.by_e.x, d.by_e.y, d.by_t.x, d.by_t.y};
}

/// Positive (with a little room for rounding): Gaussian elimination finds no negative pivot.
bool is_positive(Matrix m) {
  double largest = 0;
  for (int i = 0; i < 4; ++i) {
    largest = std::max(largest, m[i][i]);
  }
  for (int k = 0; k < 4; ++k) {
    if (m[k][k] < -1e-9 * largest) {
      return false;
    }
    for (int i = k + 1; i < 4 && m[k][k] > 0; ++i) {
      for (int j = k + 1; j < 4; ++j) {
        m[i][j] -= m[i][k] * m[k][j] / m[k][k];
      }
    }
  }
  return true;
}

Matrix differences(const RegularisedEnergy& energy, const Coordinates& at, const Aim& aim) {
  constexpr double step = 1e-5;
  Matrix found{};
  for (int i = 0; i < 4; ++i) {
    Coordinates low = at;
    Coordinates high = at;
    low.values[i] -= step;
    high.values[i] += step;
    const auto left = gradient_of(energy.derivatives(aim.shape(low)));
    const auto right = gradient_of(energy.derivatives(aim.shape(high)));
    for (int j = 0; j < 4; ++j) {
      found[i][j] = (right[j] - left[j]) / (2 * step);
    }
  }
  return found;
}

TEST_CASE("without regularisation and sizes the energy is 2 / shape") {
  test_meshes::Random random(1);
  const RegularisedEnergy energy{0, 0};
  for (int i = 0; i < 200; ++i) {
    std::array<Point2<double>, 3> z{};
    for (Point2<double>& p : z) {
      p.x = random.between(-1, 1);
      p.y = random.between(-1, 1);
    }
    if (cross(z[1] - z[0], z[2] - z[0]) < 0.01) {
      continue;
    }
    const double value = energy.value(RegularisedEnergy::shape_of(z[0], z[1], z[2], random.between(0.1, 3)));
    REQUIRE(value == Approx(2 / trismooth::shape(z[0], z[1], z[2])).epsilon(1e-9));
  }
}

TEST_CASE("of the corner of a quadrilateral the energy is 1 / shape there, half of what a triangle of its shape has") {
  test_meshes::Random random(4);
  const RegularisedEnergy energy{0, 0};
  int tried = 0;
  for (int i = 0; i < 200; ++i) {
    std::array<Point2<double>, 3> z{};
    for (Point2<double>& p : z) {
      p.x = random.between(-1, 1);
      p.y = random.between(-1, 1);
    }
    const auto& [corner, next, previous] = z;
    const double area = (next.x - corner.x) * (previous.y - corner.y) - (next.y - corner.y) * (previous.x - corner.x);
    if (area < 0.01) {
      continue;
    }
    ++tried;
    const double squares = std::pow(std::hypot(next.x - corner.x, next.y - corner.y), 2) +
                           std::pow(std::hypot(previous.x - corner.x, previous.y - corner.y), 2);
    const double value = energy.value(
        RegularisedEnergy::shape_of(corner, next, previous, random.between(0.1, 3), IdealTriangle::corner));
    REQUIRE(value == Approx(squares / (2 * area)).epsilon(1e-9));
  }
  CHECK(tried > 50);
}

TEST_CASE(
    "the gradient is that of the energy, and the Hessian its derivative where that is positive, and positive else") {
  test_meshes::Random random(2);
  int positive = 0;
  int mended = 0;
  for (int i = 0; i < 2000; ++i) {
    const RegularisedEnergy energy{random.between(0.05, 1), random.between(0, 1)};
    const double target = random.between(0.3, 2);
    const Aim aim = i % 2 == 0 ? Aim{&IdealTriangle::equilateral, 0.5 * RegularisedEnergy::root3, target}
                               : Aim{&IdealTriangle::corner, 0.5, target};
    Coordinates at{};
    for (double& value : at.values) {
      value = random.between(-1, 1);
    }
    const auto found = energy.derivatives(aim.shape(at));
    REQUIRE(found.value == Approx(energy.value(aim.shape(at))));
    const auto gradient = gradient_of(found);
    for (int k = 0; k < 4; ++k) {
      constexpr double step = 1e-5;
      Coordinates low = at;
      Coordinates high = at;
      low.values[k] -= step;
      high.values[k] += step;
      const double slope = (energy.value(aim.shape(high)) - energy.value(aim.shape(low))) / (2 * step);
      REQUIRE(gradient[k] == Approx(slope).epsilon(1e-4).margin(1e-4 * found.value));
    }
    const Matrix hessian = hessian_of(found);
    REQUIRE(is_positive(hessian));
    const Matrix expected = differences(energy, at, aim);
    Matrix shifted = expected;  // well inside of what is positive: nothing was mended there
    for (int k = 0; k < 4; ++k) {
      shifted[k][k] -= 1e-3 * found.value;
    }
    if (!is_positive(shifted)) {
      ++mended;
      continue;
    }
    ++positive;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        REQUIRE(hessian[a][b] == Approx(expected[a][b]).epsilon(1e-3).margin(1e-3 * found.value));
      }
    }
  }
  CHECK(positive > 100);
  CHECK(mended > 100);
}

TEST_CASE("the least energy is that of an equilateral triangle of its size") {
  const RegularisedEnergy energy{1e-10, 0.5};
  const double target = 0.25 * RegularisedEnergy::root3;
  const auto ideal = RegularisedEnergy::shape_of({0, 0}, {1, 0}, {0.5, 0.5 * RegularisedEnergy::root3}, target);
  const auto found = energy.derivatives(ideal);
  CHECK(found.value == Approx(2 + 0.5 * 2));
  for (const double slope : gradient_of(found)) {
    CHECK(slope == Approx(0).margin(1e-9));
  }
}

TEST_CASE("the least energy of a corner of a quadrilateral is that of a right angle with equal sides") {
  const RegularisedEnergy energy{1e-10, 0.5};
  const auto found = energy.derivatives(RegularisedEnergy::shape_of({0, 0}, {2, 0}, {0, 2}, 2, IdealTriangle::corner));
  CHECK(found.value == Approx(0.5 * (2 + 0.5 * 2)));
  for (const double slope : gradient_of(found)) {
    CHECK(slope == Approx(0).margin(1e-9));
  }
}

TEST_CASE("a triangle that is turned by a right angle has the same derivatives, turned, to the last bit") {
  test_meshes::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const RegularisedEnergy energy{random.between(0.01, 1), random.between(0, 1)};
    std::array<Point2<double>, 3> z{};
    for (Point2<double>& p : z) {
      p.x = i % 5 == 0 ? random.below(3) : random.between(-1, 1);
      p.y = i % 5 == 0 ? random.below(3) : random.between(-1, 1);
    }
    const auto of = [&] { return energy.derivatives(RegularisedEnergy::shape_of(z[0], z[1], z[2], 0.7)); };
    const auto expected = of();
    for (Point2<double>& p : z) {
      p = {-p.y, p.x};
    }
    const auto found = of();
    REQUIRE(found.value == expected.value);
    REQUIRE(found.by_e == Point2<double>{-expected.by_e.y, expected.by_e.x});
    REQUIRE(found.by_t == Point2<double>{-expected.by_t.y, expected.by_t.x});
    for (const auto& [turned, straight] : {std::pair{found.ee, expected.ee}, std::pair{found.tt, expected.tt}}) {
      REQUIRE(turned[0] == straight[2]);
      REQUIRE(turned[1] == -straight[1]);
      REQUIRE(turned[2] == straight[0]);
    }
    REQUIRE(found.et[0] == expected.et[3]);
    REQUIRE(found.et[1] == -expected.et[2]);
    REQUIRE(found.et[2] == -expected.et[1]);
    REQUIRE(found.et[3] == expected.et[0]);
  }
}

}  // namespace trismooth::regularised_energy_test
