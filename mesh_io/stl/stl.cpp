// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/stl/stl.h"

#include "trismooth/mesh_io/codec.h"

namespace trismooth {

const Codec stl_codec{
    {FileFormat::stl, "stl", "STL", {".stl"}, {.quads = false, .collapsed_quads = false, .curved_cells = false}},
    &read_stl,
    &write_stl,
    &what_stl_loses,
    &is_stl};

}  // namespace trismooth
