#include "trismooth/mesh_io/vtk_support.h"

#include <stdexcept>

// The one place that knows whether the build has VTK.
#ifdef TRISMOOTH_HAS_VTK
#include "trismooth/mesh_io/vtk_xml/silence_vtk.h"
#endif

namespace trismooth {

#ifdef TRISMOOTH_HAS_VTK

bool has_vtk() {
  return true;
}

const Codec& vtk_xml_codec(FileFormat format) {
  return format == FileFormat::vtu ? vtu_codec : vtp_codec;
}

void silence_libraries() {
  silence_vtk();
}

#else

bool has_vtk() {
  return false;
}

const Codec& vtk_xml_codec(FileFormat /*format*/) {
  throw std::logic_error("this build has no VTK, and no codec for .vtu and .vtp");
}

void silence_libraries() {}

#endif

}  // namespace trismooth
