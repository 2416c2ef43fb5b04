// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes smooth() and Plan for arrays in memory of the host.
void bind_smoothing(nanobind::module_& module);

/// Makes MovingMesh for them.
void bind_moving(nanobind::module_& module);

/// Makes quality() for them.
void bind_quality_of_arrays(nanobind::module_& module);

}  // namespace trismooth::python
