// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// Charts as SVG elements to stand in an HTML page, whose style sheet (html_style.h) colours them.

/// The histogram of shape, with the inverted triangles as a bar of their own where there are any. `after` may be null.
std::string shape_histogram_svg(const QualityReport& before, const QualityReport* after);

/// The vertices that moved in each sweep, on a logarithmic scale. `history` holds one record or more.
std::string convergence_svg(std::span<const SweepRecord> history);

}  // namespace trismooth
