// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "trismooth/pipeline/generate/grid_predicates.h"

namespace trismooth {

// The standard's distributions and std::shuffle may differ between libraries. These take the generator's bits
// themselves, so a seed means the same everywhere.

/// A number uniformly random in [0, bound). Precondition: bound > 0. At most two draws on average.
std::uint64_t random_below(std::uint64_t bound, std::mt19937_64& generator);

/// The numbers 0 .. count-1 in an order uniformly random among all.
std::vector<std::int32_t> random_permutation(std::int32_t count, std::mt19937_64& generator);

/// `count` distinct grid points, in uniformly random order and uniformly random among those whose coordinates lie in
/// [lowest, end). Points that turn up twice are drawn again.
/// Precondition: 0 <= lowest < end, 2 <= end <= 2^30, and there are at least twice as many such points.
/// Complexity: O(count log(count)); each point takes less than four draws and, where end is a power of two and lowest
/// is small, about one.
std::vector<GridPoint> random_points(std::int64_t count, std::int32_t lowest, std::int32_t end,
                                     std::mt19937_64& generator);

}  // namespace trismooth
