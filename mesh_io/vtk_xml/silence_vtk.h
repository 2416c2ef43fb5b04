// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// For programs whose standard error is for people: what VTK has to say beside the errors that are asked for goes
/// nowhere from now on, in the whole process. It tells of its own objects, by their addresses and in many lines.
void silence_vtk();

}  // namespace trismooth
