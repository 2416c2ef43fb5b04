// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include "trismooth/python/backends.h"
#include "trismooth/python/device.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/files.h"
#include "trismooth/python/flat_mesh.h"
#include "trismooth/python/results.h"
#include "trismooth/python/smoothing.h"
#include "trismooth/python/view.h"
#include "trismooth/version.h"

NB_MODULE(_core, module) {
  using namespace trismooth::python;
  // Of objects that others keep to the end of the process: nothing that its user could do anything about.
  nanobind::set_leak_warnings(false);
  module.doc() = "The compiled part of trismooth. Use the package trismooth.";
  module.attr("__version__") = TRISMOOTH_VERSION;
  bind_errors(module);
  bind_results(module);
  bind_smoothing(module);
  bind_moving(module);
  bind_quality_of_arrays(module);
  bind_flat_mesh(module);
  bind_view(module);
  bind_device(module);
  bind_files(module);
  module.def("cuda_text", &cuda_text);
}
