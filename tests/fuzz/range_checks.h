// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/mesh_io/mesh_document.h"

#include "choices.h"

namespace fuzz {

/// Reads a file by ranges, as ranks do: where that works all ranges together are the whole file. `whole`: what its
/// reader says, null where it refuses the file. Throws Broken. Nothing for formats that are not read by ranges.
void check_ranges(trismooth::FileFormat format, const std::string& bytes, const trismooth::MeshDocument* whole,
                  HashedChoices& choices);

}  // namespace fuzz
