// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// Whether this build has VTK, which reads and writes .vtu and .vtp.
bool has_vtk();

/// silence_vtk() where the build has it.
void silence_libraries();

}  // namespace trismooth
