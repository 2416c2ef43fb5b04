// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/view.h"

namespace trismooth::python {

/// A build without files has no page either: _core.has_files says so.
void bind_view(nanobind::module_& /*module*/) {}

}  // namespace trismooth::python
