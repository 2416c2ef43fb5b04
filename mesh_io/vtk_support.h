#pragma once

#include "trismooth/mesh_io/codec.h"

namespace trismooth {

/// Whether this build has VTK, which reads and writes .vtu and .vtp.
bool has_vtk();

/// The codec of FileFormat::vtu or FileFormat::vtp; only where the build has_vtk().
const Codec& vtk_xml_codec(FileFormat format);

/// silence_vtk() where the build has it.
void silence_libraries();

}  // namespace trismooth
