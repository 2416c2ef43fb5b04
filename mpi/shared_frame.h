// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/mpi/communicator.h"

namespace trismooth::mpi {

/// The local frame of the whole mesh, from the points of each rank's overlap and why each vertex is held (bits of
/// namespace hold). Collective. Complexity: linear in what the rank has.
LocalFrame shared_frame(std::span<const Point2<double>> points, std::span<const std::uint8_t> held,
                        const Communicator& ranks);

}  // namespace trismooth::mpi
