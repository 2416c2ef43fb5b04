#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/machine/ordered_sum.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// Preconditioned conjugate gradients for a symmetric positive definite system over points. apply(x, v) is row v of the
/// matrix times x, precondition(v, r) the preconditioner's answer to the residual r of v. `x` holds the start and gets
/// the solution, `residual` that of the start. Stops where the residual (in the preconditioner's norm) is `tolerance`
/// times `reference`, after `most` steps, or where the numbers leave the range of double. Returns that norm.
template <class Apply, class Precondition>
double conjugate_gradients(const Apply& apply, const Precondition& precondition, std::span<Point2<double>> x,
                           std::span<Point2<double>> residual, double reference, double tolerance, int most,
                           Workers& workers) {
  const auto count = static_cast<std::int32_t>(x.size());
  const auto dot = [](Point2<double> a, Point2<double> b) { return a.x * b.x + a.y * b.y; };
  const auto sum = [&](const auto& term) { return ordered_sum(count, term, workers); };
  std::vector<Point2<double>> answer(x.size());
  std::vector<Point2<double>> direction(x.size(), {0, 0});
  std::vector<Point2<double>> image(x.size());
  double rho = 0;
  double beta = 0;
  for (int step = 0;; ++step) {
    const double next_rho = sum([&](std::int32_t v) {
      answer[v] = precondition(v, residual[v]);
      return dot(answer[v], residual[v]);
    });
    if (!(next_rho > 0) || !std::isfinite(next_rho) || step == most || std::sqrt(next_rho) <= tolerance * reference) {
      return std::sqrt(std::max(next_rho, 0.0));
    }
    beta = step == 0 ? 0 : next_rho / rho;
    rho = next_rho;
    workers.for_blocks(count, 4096, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        direction[v] = {answer[v].x + beta * direction[v].x, answer[v].y + beta * direction[v].y};
      }
    });
    const double curvature = sum([&](std::int32_t v) {
      image[v] = apply(direction, v);
      return dot(direction[v], image[v]);
    });
    const double alpha = rho / curvature;
    if (!(curvature > 0) || !std::isfinite(alpha)) {
      return std::sqrt(rho);
    }
    workers.for_blocks(count, 4096, [&](std::int64_t begin, std::int64_t end) {
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        x[v] = {x[v].x + alpha * direction[v].x, x[v].y + alpha * direction[v].y};
        residual[v] = {residual[v].x - alpha * image[v].x, residual[v].y - alpha * image[v].y};
      }
    });
  }
}

}  // namespace trismooth
