// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/accurate_area.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "trismooth/base/exact_arithmetic.h"

namespace trismooth {

namespace {

/// A number and what was lost when it was rounded.
struct Rounded {
  double value;
  double rest;
};

Rounded exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  const double of_a = sum - of_b;
  return {sum, (a - of_a) + (b - of_b)};
}

/// The upper half of the digits (Dekker).
double upper_digits(double a) {
  constexpr double splitter = 0x1p27 + 1;
  const double large = splitter * a;
  return large - (large - a);
}

Rounded exact_product(double a, double b) {
  const double product = a * b;
  const double a_high = upper_digits(a);
  const double b_high = upper_digits(b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

/// A sum without rounding: parts that do not overlap, from the smallest to the largest.
class ExactSum {
 public:
  void add_product(double a, double b) {
    const Rounded product = exact_product(a, b);
    add(product.rest);
    add(product.value);
  }

  double rounded() const {
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      sum += parts_[i];
    }
    return sum;
  }

 private:
  void add(double number) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Rounded sum = exact_sum(number, parts_[i]);
      number = sum.value;
      if (sum.rest != 0) {
        parts_[kept++] = sum.rest;
      }
    }
    parts_[kept++] = number;
    count_ = kept;
  }

  std::array<double, 12> parts_{};
  std::size_t count_ = 0;
};

}  // namespace

double doubled_area(Point2<double> a, Point2<double> b, Point2<double> c) {
  const Point2<double> ca = a - c;
  const Point2<double> cb = b - c;
  const double left = ca.x * cb.y;
  const double right = ca.y * cb.x;
  const double difference = left - right;
  constexpr double enough = 0x1p-8;  // its error is within 2^-51 of the sum of the two
  if (std::abs(difference) > enough * (std::abs(left) + std::abs(right))) {
    return difference;
  }
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.rounded();
}

}  // namespace trismooth
