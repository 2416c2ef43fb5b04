// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/quality/metrics.h"
#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// The metric of an element among its neighbours: the largest ratio of the areas of two elements over one of its
/// sides, the larger one by the smaller one. 1 where all neighbours are as large as it is, and where it has none;
/// infinite beside an element without area. Sizes count, not orientation; sides of three elements or more have no
/// ratio. SMS's "area change" is its inverse: at least 0.5 there is at most 2 here. (`metric`: the one like which it is
/// shown.)
inline constexpr MetricInfo size_ratio_info{Metric::edge_ratio,
                                            "size_ratio",
                                            "",
                                            false,
                                            1,
                                            2,
                                            1,
                                            std::numeric_limits<double>::infinity(),
                                            "largest ratio of areas over a side: 1 where neighbours are alike"};

/// The metric of every element. `threads` as in QualityOptions. Complexity: linear; 12 bytes for each side while it
/// runs. Throws MeshError for elements that are no mesh: see match_sides().
[[nodiscard]] std::vector<double> size_ratios(const MeshView& view, int threads = 0);

/// The metric over all elements, the same to the bit for every number of threads. Acceptable is 2 or less. Complexity
/// and errors are those of size_ratios().
[[nodiscard]] MetricSummary size_ratio_summary(const MeshView& view, int threads = 0);

/// Every metric that the report has, in the order in which they are shown: those of triangles and those of
/// quadrilaterals that triangles have none of, whichever are there, and size_ratio_info where somebody has asked for
/// it.
[[nodiscard]] std::vector<const MetricInfo*> metrics_of(const QualityReport& report);

/// The summary of one of these.
[[nodiscard]] const MetricSummary& summary_of(const QualityReport& report, const MetricInfo& metric);

}  // namespace trismooth
