// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/constraint_arrays.h"

#include "trismooth/python/host_array.h"

namespace nb = nanobind;

namespace trismooth::python {

nb::handle constraint_of(const nb::dict& constraints, const char* name) {
  PyObject* const array = PyDict_GetItemString(constraints.ptr(), name);  // borrowed
  return array == nullptr ? nb::handle(Py_None) : nb::handle(array);
}

ConstraintArrays::ConstraintArrays(const nb::dict& constraints, std::size_t vertex_count, std::size_t triangle_count)
    : regions_(integers(constraint_of(constraints, "regions"), "regions", triangle_count, "triangle")),
      fixed_(vertex_flags(constraint_of(constraints, "fixed"), "fixed", vertex_count)),
      other_cells_(vertex_flags(constraint_of(constraints, "other_cells"), "other_cells", vertex_count)),
      sizes_(reals(constraint_of(constraints, "size"), "size", vertex_count)),
      lines_(vertex_pairs(constraint_of(constraints, "lines"), "lines", vertex_count)),
      line_tags_(integers(constraint_of(constraints, "line_tags"), "line_tags", lines_.size() / 2, "line")),
      links_(vertex_pairs(constraint_of(constraints, "links"), "links", vertex_count)) {}

Constraints ConstraintArrays::constraints(const Sliding& slide) const {
  Constraints all{.fixed = fixed_, .other_cells = other_cells_, .regions = regions_, .slide = slide};
  all.slide.lines = lines_;
  all.slide.line_tags = line_tags_;
  all.slide.links = links_;
  return all;
}

}  // namespace trismooth::python
