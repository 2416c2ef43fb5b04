// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

class Workers;

/// The places of the elements around the worst ones, of the mesh as it was and as it is, ascending: those that reach
/// into a square around each, 24 times as wide as it is, or less where that would be thousands. Complexity: linear, for
/// each of the worst.
std::vector<std::int32_t> elements_near_worst(const MeshPicture& picture, Workers& workers);

}  // namespace trismooth
