// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// Triangles that a part of a report is of: from a multiple of it on, in the order of the triangles. Parts are joined
/// in that order too, so no rounding depends on who makes them.
inline constexpr std::size_t triangles_a_quality_part = 1024;

/// What some triangles, one after the other, contribute to a report. Bytes may be copied.
struct QualityPart {
  double count = 0;
  std::int64_t inverted = 0;
  std::int64_t degenerate = 0;
  MetricValues sum = filled(0);
  MetricValues squared_deviations = filled(0);  ///< from the mean of these triangles, summed
  MetricValues min = filled(std::numeric_limits<double>::infinity());
  MetricValues max = filled(-std::numeric_limits<double>::infinity());
  std::array<std::int64_t, metric_count> acceptable{};
  std::array<std::int64_t, shape_bins> shape_histogram{};

  /// Adds what the triangles behind these contribute.
  void append(const QualityPart& next);

 private:
  static constexpr MetricValues filled(double value) {
    MetricValues values{};
    values.fill(value);
    return values;
  }
};

/// The parts of a view, each of triangles_a_quality_part triangles but for the last, and its worst triangles.
struct QualityParts {
  std::vector<QualityPart> parts;
  std::vector<WorstElement> worst;  ///< as QualityReport::worst
};

/// Makes them. Errors and complexity as those of quality_report().
QualityParts quality_parts(const TriangleView& view, const QualityOptions& options);

/// Whether the one comes before the other in QualityReport::worst.
bool is_worse(const WorstElement& a, const WorstElement& b);

/// The report of triangles that contribute `total`, in a local frame of that exponent.
QualityReport report_of(const QualityPart& total, std::vector<WorstElement> worst, int exponent);

}  // namespace trismooth
