// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes view_page(), the page that shows a mesh of arrays before and after.
void bind_view(nanobind::module_& module);

}  // namespace trismooth::python
