// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "trismooth/smoothing/backend.h"

namespace trismooth {

class SweepOffloads;

/// The CPU backend. Layout and execution mean nothing to it; Order::unordered is refused.
const Backend& cpu_backend();

/// Makes a part of a mesh (MeshRings::part) ready, whose sweeps `offloads` make: all else is done by the CPU, as its
/// backend does it. For the backends of devices; arguments as those of Backend::prepare(). Collective over the parts.
std::unique_ptr<PreparedSmoother> prepare_part(MeshRings mesh, const ElementList& elements,
                                               std::span<const Point2<double>> local, const SmoothingOptions& options,
                                               std::unique_ptr<SweepOffloads> offloads);

}  // namespace trismooth
