// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "trismooth/base/host_device.h"
#include "trismooth/base/point2.h"

namespace trismooth {

namespace conjugate_gradients_details {

struct Product {
  const Point2<double>* a;
  const Point2<double>* b;

  TRISMOOTH_HOST_DEVICE double operator()(std::int32_t v) const { return a[v].x * b[v].x + a[v].y * b[v].y; }
};

template <class Precondition>
struct AnswerAndProduct {
  Precondition precondition;
  const Point2<double>* residual;
  Point2<double>* answer;

  TRISMOOTH_HOST_DEVICE double operator()(std::int32_t v) const {
    answer[v] = precondition(v, residual[v]);
    return Product{answer, residual}(v);
  }
};

struct Turn {
  const Point2<double>* answer;
  double beta;
  Point2<double>* direction;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const {
    direction[v] = {answer[v].x + beta * direction[v].x, answer[v].y + beta * direction[v].y};
  }
};

template <class Apply>
struct Curvature {
  Apply apply;
  const Point2<double>* direction;
  Point2<double>* image;

  TRISMOOTH_HOST_DEVICE double operator()(std::int32_t v) const {
    image[v] = apply(direction, v);
    return Product{direction, image}(v);
  }
};

struct Advance {
  double alpha;
  const Point2<double>* direction;
  const Point2<double>* image;
  Point2<double>* x;
  Point2<double>* residual;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t v) const {
    x[v] = {x[v].x + alpha * direction[v].x, x[v].y + alpha * direction[v].y};
    residual[v] = {residual[v].x - alpha * image[v].x, residual[v].y - alpha * image[v].y};
  }
};

}  // namespace conjugate_gradients_details

/// Preconditioned conjugate gradients for a symmetric positive definite system of `count` rows over points. `rows`:
/// HostRows, or what has its functions; all memory is where it works. apply(x, v) is row v of the matrix times x,
/// precondition(v, r) the preconditioner's answer to the residual r of v, or precondition(r, answer) all answers to all
/// residuals. `x` holds the start and gets the solution, `residual` that of the start. Stops where the residual (in the
/// preconditioner's norm) is `tolerance` times `reference`, after `most` steps, or where the numbers leave the range of
/// double. Returns that norm.
template <class Apply, class Precondition, class Rows>
double conjugate_gradients(const Apply& apply, const Precondition& precondition, std::int32_t count, Point2<double>* x,
                           Point2<double>* residual, double reference, double tolerance, int most, Rows& rows) {
  using namespace conjugate_gradients_details;
  const auto size = static_cast<std::size_t>(count);
  auto answers = rows.template zeros<Point2<double>>(size);
  auto directions = rows.template zeros<Point2<double>>(size);
  auto images = rows.template zeros<Point2<double>>(size);
  Point2<double>* const answer = answers.data();
  Point2<double>* const direction = directions.data();
  Point2<double>* const image = images.data();
  double rho = 0;
  for (int step = 0;; ++step) {
    double next_rho = 0;
    if constexpr (std::is_invocable_v<Precondition, const Point2<double>*, Point2<double>*>) {
      precondition(static_cast<const Point2<double>*>(residual), answer);
      next_rho = rows.sum(count, Product{answer, residual});
    } else {
      next_rho = rows.sum(count, AnswerAndProduct<Precondition>{precondition, residual, answer});
    }
    if (!(next_rho > 0) || !std::isfinite(next_rho) || step == most || std::sqrt(next_rho) <= tolerance * reference) {
      return std::sqrt(std::max(next_rho, 0.0));
    }
    rows.for_rows(count, Turn{answer, step == 0 ? 0 : next_rho / rho, direction});
    rho = next_rho;
    const double curvature = rows.sum(count, Curvature<Apply>{apply, direction, image});
    const double alpha = rho / curvature;
    if (!(curvature > 0) || !std::isfinite(alpha)) {
      return std::sqrt(rho);
    }
    rows.for_rows(count, Advance{alpha, direction, image, x, residual});
  }
}

}  // namespace trismooth
