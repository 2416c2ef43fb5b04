#pragma once

#include <cstdint>

#include "trismooth/mpi/plan.h"

namespace mpi_tests {

/// Smooths `count` random meshes, each in two ways, as a whole by the CPU and cut into pieces by `backend` (null: the
/// CPU): the bits, and all figures, are to be the same on all ranks. `slides`: vertices of boundaries do.
void check_random_meshes(std::int64_t count, trismooth::mpi::Gather gather, bool slides,
                         const trismooth::Backend* backend = nullptr);

}  // namespace mpi_tests
