// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes what there is for files and the command line; `has_files` says whether the build has it.
void bind_files(nanobind::module_& module);

}  // namespace trismooth::python
