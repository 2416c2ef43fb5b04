// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/silence_vtk.h"

#include <vtkLogger.h>

namespace trismooth {

void silence_vtk() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

}  // namespace trismooth
