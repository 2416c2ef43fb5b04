// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "trismooth/mpi/communicator.h"
#include "trismooth/pipeline/pipeline.h"

namespace trismooth {

/// Throws mpi::KnownToAll on all ranks, naming the first option of the program that is not the same on all of them.
/// Threads, reports and gates may differ, and the topology, of which no result depends; rank 0 has the say. Collective.
void require_same_options(const PipelineOptions& options, const mpi::Communicator& ranks);

/// The option that needs the whole mesh on one rank; empty where none does. Local.
std::string_view what_needs_whole_mesh(const PipelineOptions& options);

/// Throws std::invalid_argument, naming the first, for options that a mesh in pieces does not have, and for an output
/// that is none for it. Throws WriteError for one of no known format. Local.
void require_piece_options(const PipelineOptions& options);

}  // namespace trismooth
