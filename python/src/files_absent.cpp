// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "trismooth/python/files.h"

namespace trismooth::python {

void bind_files(nanobind::module_& module) {
  module.attr("has_files") = false;
  // Who catches them need not ask for the build.
  for (const auto& [name, base] : {std::pair("ReadError", PyExc_OSError), std::pair("WriteError", PyExc_OSError),
                                   std::pair("Cancelled", PyExc_RuntimeError)}) {
    module.attr(name) = nanobind::steal(PyErr_NewException((std::string("trismooth.") + name).c_str(), base, nullptr));
  }
}

}  // namespace trismooth::python
