// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes flat_mesh(), by which the adapters learn what a mesh of another package means: its triangles, its regions and
/// what is held, as the program has it of a file.
void bind_flat_mesh(nanobind::module_& module);

}  // namespace trismooth::python
