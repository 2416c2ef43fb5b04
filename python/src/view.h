// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nanobind/nanobind.h>

namespace trismooth {
struct MeshPicture;
}

namespace trismooth::python {

/// Makes view_page(), the page that shows a mesh of arrays before and after.
void bind_view(nanobind::module_& module);

/// A page that shows the mesh of that picture, under that title. Takes no part in Python.
std::string page_of(const std::string& title, const MeshPicture& picture, int threads);

}  // namespace trismooth::python
