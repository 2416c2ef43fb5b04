// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mpi/communicator.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth::mpi {

/// An option's name, and a number that is the same where its value is.
using OptionValue = std::pair<std::string, std::int64_t>;

/// Those that have to be the same on all ranks. Threads, target lengths, progress and the lines and links to slide on
/// may differ. Local.
std::vector<OptionValue> option_values(const SmoothingOptions& options, const Sliding& slide);

/// Throws std::invalid_argument on all ranks, naming the first option that is not the same on all of them. `values`: of
/// the same options on every rank. Collective.
void require_same(std::span<const OptionValue> values, const Communicator& communicator);

}  // namespace trismooth::mpi
