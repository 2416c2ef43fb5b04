// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

struct RunState;

/// What pictures show of the mesh as it is now: the first time of the mesh that was read, then of that one and of its
/// result. Its quality is known. Complexity: linear.
std::shared_ptr<const MeshPicture> picture_of(const RunState& run);

}  // namespace trismooth
