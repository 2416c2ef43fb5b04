// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace trismooth {

/// Readers refuse arrays without rows that have more components: VTK takes memory for each, and a file of a few lines
/// could ask for all that there is.
inline constexpr std::size_t most_components_without_rows = 100;

}  // namespace trismooth
