// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/parts/mesh_part.h"
#include "trismooth/smoothing/sweeps/sweep_offload.h"

namespace trismooth {

/// Who makes the sweeps of a part; null: the CPU. Called once for each part, on the thread that smooths it.
using OffloadsOfPart = std::function<std::unique_ptr<SweepOffloads>(const MeshPart&)>;

/// Makes a mesh ready that this process has as a whole, to be smoothed in `parts` parts by as many threads, each of
/// which has its share of options.threads. Arguments are those of Backend::prepare(); nothing slides. The result has
/// the bits of the whole. smooth() throws PartsError where the mesh has inverted elements and they are to be
/// untangled; points are untouched whenever it throws.
std::unique_ptr<PreparedSmoother> prepare_in_parts(MeshRings mesh, const ElementList& elements,
                                                   std::span<const Point2<double>> local,
                                                   const SmoothingOptions& options, int parts,
                                                   const OffloadsOfPart& offloads = {});

}  // namespace trismooth
