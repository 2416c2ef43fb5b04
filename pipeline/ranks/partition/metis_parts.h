// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/pipeline/ranks/partition/block_graph.h"

namespace trismooth {

/// Which METIS the build has; empty: none. Local.
std::string metis_version();

/// The part of each block of the graph, by METIS: parts of about the same weight with few edges between them. The same
/// in every run. `parts`: at least 2. Throws std::bad_alloc, and std::logic_error where the build has no METIS. Local.
std::vector<std::int32_t> metis_parts(const BlockGraph& graph, int parts);

}  // namespace trismooth
