// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

class Workers;

}

namespace trismooth::mpi {

class Communicator;

/// trismooth::hold_layers() of a mesh in pieces: what it would find in the whole mesh. `points`: one for each vertex of
/// the overlap, in the local frame; `reversed`: as MeshRings::reversed, of its elements. `fixed`: one byte a vertex of
/// the overlap, ghosts too. Collective. The flat triangles that may be in a layer go to rank 0, which looks at them: 64
/// bytes each, and few in a mesh without layers.
LayersResult hold_layers(const Overlap& overlap, std::span<const Point2<double>> points,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, const Communicator& ranks, Workers& workers);

}  // namespace trismooth::mpi
