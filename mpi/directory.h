// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/mpi/communicator.h"

namespace trismooth::mpi {

/// The rank that is asked about an id: ids are scattered over all ranks, so none has to know them all. Local.
int home_of(std::int64_t id, const Communicator& communicator);

/// The owner of each of this rank's vertices. `claimed`: what the rank says of each itself, empty: nothing; then it is
/// the lowest rank that has the vertex. Collective. Throws std::invalid_argument where ranks disagree, or say it of
/// some and not of others.
std::vector<std::int32_t> owners_of(std::span<const std::int64_t> ids, std::span<const std::int32_t> claimed,
                                    const Communicator& communicator);

/// Throws std::invalid_argument, which names `what`, on all ranks, where the same id is there twice, on one rank or on
/// two. Collective.
void require_unique(std::span<const std::int64_t> ids, const char* what, const Communicator& communicator);

}  // namespace trismooth::mpi
