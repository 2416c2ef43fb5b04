// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The vertices that a point array holds.
struct FixedArray {
  std::string array;                ///< the array that was obeyed; empty where there is none
  std::vector<std::uint8_t> flags;  ///< per vertex: 1 where a component of the array is not zero; empty without one
  std::int64_t vertices = 0;        ///< how many are 1
};

/// The one of a mesh's point arrays that is called `name`, or without a name "fixed", in whatever case; nullptr where
/// there is none. What the program adds to a file to show what it held has another name (annotation_names.h), so it is
/// not taken for the user's word. Complexity: linear in the arrays.
const DataArray* choose_fixed_array(std::span<const DataArray> arrays, const std::optional<std::string>& name);

/// The name that says that no array holds vertices.
inline constexpr std::string_view no_fixed_array = "none";

/// What the one that choose_fixed_array() names holds, if there is one; nothing where the name is no_fixed_array.
/// Throws std::invalid_argument where another `name` is given and the document has no such array, naming those it has.
/// Complexity: linear.
FixedArray find_fixed_array(const MeshDocument& document, const std::optional<std::string>& name);

}  // namespace trismooth
