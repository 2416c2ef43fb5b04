// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "properties/contract.h"
#include "properties/smoothing_cases.h"

namespace properties {

/// How far from a decision that would have gone the other way a smoothing of the mesh comes, as a length in the mesh's
/// units, by a smoothing in long double: by how much, about, the coordinates must change for a vertex to move that
/// stayed, or to stay that moved, or for the guard to take back others.
double decision_margin(const RandomMesh& mesh, const Connectivity& connectivity, const SmoothingOptions& options);

}  // namespace properties
