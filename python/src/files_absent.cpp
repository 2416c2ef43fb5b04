#include "trismooth/python/files.h"

namespace trismooth::python {

void bind_files(nanobind::module_& module) {
  module.attr("has_files") = false;
}

}  // namespace trismooth::python
