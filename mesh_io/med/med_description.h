// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/format_description.h"

namespace trismooth {

/// Also where the build has no HDF5 and can name the format alone.
inline constexpr FormatDescription med_description{
    FileFormat::med, "med", "MED", {".med", ".rmed", ".mmed"}, {.arrays = true, .names = true, .units = true}, 1,
    "HDF5"};

}  // namespace trismooth
