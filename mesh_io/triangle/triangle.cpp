// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/triangle/triangle_files.h"
#include "trismooth/mesh_io/triangle/triangle_reader.h"
#include "trismooth/mesh_io/triangle/triangle_writer.h"

namespace trismooth {

const Codec triangle_codec{{FileFormat::triangle,
                            "triangle",
                            "Triangle",
                            {".node", ".ele"},
                            {.names = true, .quads = false, .collapsed_quads = false}},
                           &read_triangle,
                           &write_triangle,
                           &lost_in_triangle,
                           nullptr,
                           &triangle_output_partner};

}  // namespace trismooth
