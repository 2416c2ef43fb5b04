// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// The reports as a table for people, plain ASCII, ending in a line feed: counts, every metric, the histogram of shape
/// and the worst elements. With `after`, each metric has a line for both, and by how much its worst value changed,
/// however little that is. Lines have 80 columns unless coordinates need more. `after` may be null. `region_names`, in
/// plain ASCII and of 10 characters at most, are those of the worst elements' regions; none: no regions are shown.
std::string format_table(const QualityReport& before, const QualityReport* after = nullptr,
                         std::span<const std::string> region_names = {});

/// The least that tells whether a smoothing was good, as such a table of a few lines: the worst value and the mean of
/// shape and angles, before and after, the inverted triangles, and the degenerate ones if there are any.
std::string format_summary(const QualityReport& before, const QualityReport& after);

}  // namespace trismooth
