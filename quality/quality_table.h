#pragma once

#include <string>

#include "trismooth/quality/quality_report.h"

namespace trismooth {

/// The reports as a table for people, plain ASCII, ending in a line feed: counts, every metric, the histogram of shape
/// and the worst elements. With `after`, the two stand side by side, and a metric's worst value is given as many
/// digits as it takes to see that it changed; lines have 100 columns unless that needs more. `after` may be null.
std::string format_table(const QualityReport& before, const QualityReport* after = nullptr);

}  // namespace trismooth
