// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// That description, which may be null, with one role more.
std::shared_ptr<const ArrayDescription> with_role(const ArrayDescription* description, std::string role);

/// What VTK calls the unit of an array, and other formats get it by.
ArrayInformation unit_information(std::string unit);

/// The unit of an array; empty: none.
std::string unit_of(const DataArray& array);

/// Gives the array, which has none, that unit; an empty one is none.
void set_unit(DataArray& array, std::string unit);

/// True for the ranges that VTK keeps beside numbers. No document holds them: they are those of the numbers before the
/// smoothing, and VTK computes them anew.
bool is_range_information(std::string_view name, std::string_view location);

}  // namespace trismooth
