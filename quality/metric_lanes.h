// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "trismooth/quality/element.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

/// A metric of an element: the functions of metrics.h for its kind.
inline double evaluate(Metric metric, const CornerPoints& corners) {
  return evaluate(metric, corners[0], corners[1], corners[2]);
}

/// evaluate_all() of every triangle, to the bit, several at a time. `values`: one for each of `triangles`.
void evaluate_all(std::span<const CornerPoints> triangles, std::span<MetricValues> values);

/// What is_acceptable() of a metric.
struct AcceptableRange {
  double low;
  double high;

  /// (No branch: & is meant.)
  bool holds(double value) const { return (value >= low) & (value <= high); }
};
AcceptableRange acceptable_range(Metric metric);

}  // namespace trismooth
