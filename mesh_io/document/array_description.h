// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// That description, which may be null, with one role more.
std::shared_ptr<const ArrayDescription> with_role(const ArrayDescription* description, std::string role);

/// True for the ranges that VTK keeps beside numbers. No document holds them: they are those of the numbers before the
/// smoothing, and VTK computes them anew.
bool is_range_information(std::string_view name, std::string_view location);

}  // namespace trismooth
