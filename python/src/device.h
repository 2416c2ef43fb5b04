// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes what there is for arrays in device memory; `has_cuda` says whether the build has it.
void bind_device(nanobind::module_& module);

/// Makes MovingMesh for them; where there is a device.
void bind_device_moving(nanobind::module_& module);

}  // namespace trismooth::python
