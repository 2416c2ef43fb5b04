// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/quality/element.h"
#include "trismooth/quality/kind_metrics.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

/// A metric of an element: the functions of metrics.h for its kind.
inline double evaluate(Metric metric, const CornerPoints& corners) {
  return evaluate(metric, corners[0], corners[1], corners[2]);
}

inline double evaluate(Metric metric, const QuadrilateralPoints& corners) {
  return evaluate(metric, corners[0], corners[1], corners[2], corners[3]);
}

/// evaluate_all() of every element, to the bit, several at a time. `values`: of each of `elements` those metrics that
/// it has.
void evaluate_all(std::span<const CornerPoints> elements, std::span<KindValues<CornerPoints>> values);
void evaluate_all(std::span<const QuadrilateralPoints> elements, std::span<KindValues<QuadrilateralPoints>> values);

/// What is_acceptable() of a metric.
struct AcceptableRange {
  double low;
  double high;

  /// (No branch: & is meant.)
  bool holds(double value) const { return (value >= low) & (value <= high); }
};
AcceptableRange acceptable_range(Metric metric, ElementKind kind = ElementKind::triangle);

}  // namespace trismooth
