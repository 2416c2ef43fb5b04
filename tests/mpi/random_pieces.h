// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "trismooth/mpi/plan.h"

#include "mpi/pieces.h"
#include "properties/smoothing_cases.h"

namespace mpi_tests {

/// Smooths a mesh in pieces that are cut in that way, twice by one plan: the first thing in which that differs from the
/// run of the whole, on all ranks. A tangled mesh is to be refused, unless `gather` allows it.
std::string in_pieces(const RandomMesh& mesh, const properties::SmoothingOptions& options, const properties::Run& whole,
                      Cut cut, trismooth::mpi::Gather gather);

/// Smooths `count` random meshes, each in two ways, as a whole by the CPU and cut into pieces by `backend` (null: the
/// CPU): the bits, and all figures, are to be the same on all ranks. `slides`: vertices of boundaries do.
void check_random_meshes(std::int64_t count, trismooth::mpi::Gather gather, bool slides,
                         const trismooth::Backend* backend = nullptr);

/// Whether a random mesh is for a job of as many ranks as this one: those of 2, 3 and 4 share the meshes. With
/// TRISMOOTH_SEED all are.
bool is_for_this_job(std::uint64_t seed);

}  // namespace mpi_tests
