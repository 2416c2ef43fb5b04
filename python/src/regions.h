#pragma once

#include <nanobind/nanobind.h>

namespace trismooth::python {

/// Makes what the adapters ask of cell arrays, judge_regions(), is_region_name() and is_side_name(), and of point
/// arrays, judge_markers() and is_marker_name().
void bind_regions(nanobind::module_& module);

}  // namespace trismooth::python
