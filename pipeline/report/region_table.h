// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// The quality of every region for people: a table in plain text of at most 80 columns, a line a region, before and
/// after where the mesh was smoothed. Of more than `most` regions the worst by their smallest shape (after, where there
/// is one), in their order, and a line that says how many are left out. Empty where there are no two regions.
std::string region_table(const PipelineResult& result, std::size_t most = 20);

/// The names of the regions as tables in plain text have them: in plain ASCII, and not longer than leaves room for
/// numbers, 10 characters. None where there are no two regions.
std::vector<std::string> short_region_names(const PipelineResult& result);

/// Regions that a run without --verbose still shows in a table.
inline constexpr std::size_t few_regions = 12;

/// The quality of every region for a page: an HTML table.
std::string region_table_html(const PipelineResult& result);

}  // namespace trismooth
