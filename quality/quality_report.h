// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/metrics.h"

namespace trismooth {

/// One metric over all elements of a mesh. Where a value is infinite, so is an end of the range, and mean and stddev
/// are infinite or NaN. All NaN where there is no element that has it.
struct MetricSummary {
  double min = 0;
  double mean = 0;
  double max = 0;
  double stddev = 0;               ///< of these elements (the sum of squared deviations over their number)
  double acceptable_fraction = 0;  ///< of the elements, each by its kind: see is_acceptable
};

/// One of the elements with the smallest shape.
struct WorstElement {
  std::int64_t element = 0;   ///< its number in the list of elements
  double shape = 0;           ///< negative where inverted
  Point2<double> centroid{};  ///< in the view's frame; quality() and run_pipeline() give yours
  bool all_fixed = false;     ///< no smoothing can change it; for who knows the fixed vertices, quality_report does not
  std::int32_t region = -1;   ///< -1: none; for who knows the regions, quality_report does not
};

/// The bins of QualityReport::shape_histogram.
inline constexpr std::size_t shape_bins = 20;

/// The quality of the elements of one kind.
struct KindQuality {
  ElementKind kind = ElementKind::triangle;
  std::int64_t elements = 0;
  std::int64_t inverted = 0;                          ///< of shape < 0
  std::int64_t degenerate = 0;                        ///< whose shape is neither above nor below 0
  std::array<MetricSummary, metric_count> metrics{};  ///< indexed by Metric; NaN of those that the kind has none of

  /// The summary of one metric.
  const MetricSummary& operator[](Metric metric) const { return metrics[static_cast<std::size_t>(metric)]; }
};

/// The quality of a mesh's elements.
struct QualityReport {
  std::int64_t triangles = 0;
  std::int64_t quadrilaterals = 0;
  std::int64_t inverted = 0;    ///< elements of shape < 0
  std::int64_t degenerate = 0;  ///< elements whose shape is neither above nor below 0: no area, or a flat corner
  std::array<MetricSummary, metric_count> metrics{};  ///< indexed by Metric, over the elements that have it; area in
                                                      ///< units of the file
  /// The same of triangles alone and of quadrilaterals alone, whichever there are; empty where all are triangles.
  std::vector<KindQuality> kinds;
  std::optional<MetricSummary> size_ratio;  ///< for who has asked for it (see size_ratio.h)
  /// Bin i counts the triangles with i <= 20 shape < i + 1; the last one has 1 and what is rounded above it, too.
  /// Inverted elements are in no bin, degenerate ones in the first: the bins and `inverted` add up to elements().
  std::array<std::int64_t, shape_bins> shape_histogram{};
  std::vector<WorstElement> worst;  ///< by ascending shape, equal ones by index

  /// How many there are of both kinds.
  [[nodiscard]] std::int64_t elements() const { return triangles + quadrilaterals; }
  /// The summary of one metric.
  const MetricSummary& operator[](Metric metric) const { return metrics[static_cast<std::size_t>(metric)]; }
  MetricSummary& operator[](Metric metric) { return metrics[static_cast<std::size_t>(metric)]; }
};

/// The elements of one kind as a report of their own, without a histogram and worst ones.
[[nodiscard]] QualityReport report_of(const KindQuality& kind);

/// What steers a report.
struct QualityOptions {
  int threads = 0;       ///< 0: all; 1: this thread alone; most_threads() at most
  int worst_count = 10;  ///< how many of the worst elements to list, at most
};

/// Every metric of every element, in its canonical corner order. The report is the same to the bit for every number
/// of threads. Complexity: linear, one pass; memory of about 1 byte a triangle, and where quadrilaterals are among the
/// elements a copy of them. Throws std::invalid_argument for a number of threads out of range.
[[nodiscard]] QualityReport quality_report(const MeshView& view, const QualityOptions& options = {});

/// The smallest shape of triangles alone, several times as fast: the report's [Metric::shape].min to the bit. NaN where
/// there is none. `threads` as in QualityOptions.
[[nodiscard]] double smallest_shape(const TriangleView& view, int threads = 0);

/// Prints the report as a table for people, plain ASCII.
std::ostream& operator<<(std::ostream& stream, const QualityReport& report);

}  // namespace trismooth
