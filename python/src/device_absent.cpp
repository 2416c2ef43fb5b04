// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/device.h"

namespace trismooth::python {

void bind_device(nanobind::module_& module) {
  module.attr("has_cuda") = false;
}

}  // namespace trismooth::python
