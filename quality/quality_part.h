// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/kind_metrics.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// Elements that a part of a report is of: from a multiple of it on, in the order of the elements. Parts are joined
/// in that order too, so no rounding depends on who makes them.
inline constexpr std::size_t triangles_a_quality_part = 1024;

/// What some elements of a kind, one after the other, contribute to a report. Bytes may be copied. `Points`: of such an
/// element.
template <class Points>
struct KindPart {
  static constexpr std::size_t metrics = count_of_metrics<Points>;

  double count = 0;
  std::int64_t inverted = 0;
  std::int64_t degenerate = 0;
  KindValues<Points> sum = filled(0);
  KindValues<Points> squared_deviations = filled(0);  ///< from the mean of these elements, summed
  KindValues<Points> min = filled(std::numeric_limits<double>::infinity());
  KindValues<Points> max = filled(-std::numeric_limits<double>::infinity());
  std::array<std::int64_t, metrics> acceptable{};
  std::array<std::int64_t, shape_bins> shape_histogram{};

  /// Adds what the elements behind these contribute.
  void append(const KindPart& next);

 private:
  static constexpr KindValues<Points> filled(double value) {
    KindValues<Points> values{};
    values.fill(value);
    return values;
  }
};
using QualityPart = KindPart<CornerPoints>;

/// The parts of a view, each of triangles_a_quality_part elements but for the last, and its worst elements.
template <class Points>
struct KindParts {
  std::vector<KindPart<Points>> parts;
  std::vector<WorstElement> worst;  ///< as QualityReport::worst

  /// All parts as one.
  [[nodiscard]] KindPart<Points> total() const {
    KindPart<Points> all;
    for (const KindPart<Points>& part : parts) {
      all.append(part);
    }
    return all;
  }
};
using QualityParts = KindParts<CornerPoints>;

/// Makes them. Errors and complexity as those of quality_report().
QualityParts quality_parts(const TriangleView& view, const QualityOptions& options);
KindParts<QuadrilateralPoints> quality_parts(const QuadrilateralView& view, const QualityOptions& options);

/// Whether the one comes before the other in QualityReport::worst.
bool is_worse(const WorstElement& a, const WorstElement& b);

/// The report of triangles that contribute `total`, in a local frame of that exponent.
QualityReport report_of(const QualityPart& total, std::vector<WorstElement> worst, int exponent);
/// The report of a mesh with triangles and quadrilaterals.
QualityReport report_of(const QualityPart& triangles, const KindPart<QuadrilateralPoints>& quadrilaterals,
                        std::vector<WorstElement> worst, int exponent);

}  // namespace trismooth
