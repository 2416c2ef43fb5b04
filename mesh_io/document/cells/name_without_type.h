// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The name of a list of elements without the words that say what type they are of, and without what separated these
/// from the rest: "copper" of "copper_tri", "copper QUAD_4" and "CopperQuads" but for the case of its letters, nothing
/// of "Triangles" and "TRI_3". Programs that list elements by their type name the parts of a region so. Complexity:
/// linear.
std::string name_without_type(std::string_view name);

}  // namespace trismooth
