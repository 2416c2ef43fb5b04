// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/su2/su2_keyword_line.h"
#include "trismooth/mesh_io/su2/su2_reader.h"
#include "trismooth/mesh_io/su2/su2_writer.h"

namespace trismooth {

const Codec su2_codec{
    {FileFormat::su2, "su2", "SU2", {".su2"}, {.names = true, .curved_cells = false, .empty_groups = false}, 0},
    &read_su2,
    &write_su2,
    &lost_in_su2,
    &recognises_su2};

}  // namespace trismooth
