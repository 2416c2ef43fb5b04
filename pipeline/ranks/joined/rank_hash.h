// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/mpi/communicator.h"

namespace trismooth {

/// coordinates_hash() of the whole mesh, its vertices in the order of their ids, from what each rank has of them: one
/// place for each id, the same on all ranks that have it. Collective. Complexity: linear in what the rank has, one rank
/// after the other.
std::uint64_t hash_over_ranks(std::span<const std::int64_t> ids, std::vector<std::array<double, 3>> places,
                              const mpi::Communicator& ranks);

}  // namespace trismooth
