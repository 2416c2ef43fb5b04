// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/format_description.h"

namespace trismooth {

/// Of VTK's XML formats, also where the build has no VTK and can name them alone.
inline constexpr FormatDescription vtu_description{
    FileFormat::vtu,
    "vtu",
    "VTK XML (unstructured grid)",
    {".vtu"},
    {.arrays = true, .units = true, .strips = true, .cells_of_any_order = true},
    {},
    "VTK"};
inline constexpr FormatDescription vtp_description{
    FileFormat::vtp,
    "vtp",
    "VTK XML (polygonal data)",
    {".vtp"},
    {.arrays = true, .units = true, .curved_cells = false, .strips = true},
    {},
    "VTK"};

}  // namespace trismooth
