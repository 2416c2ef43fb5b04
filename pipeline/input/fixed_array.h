#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The vertices that a point array holds.
struct FixedArray {
  std::string array;                ///< the array that was obeyed; empty where there is none
  std::vector<std::uint8_t> flags;  ///< per vertex: 1 where a component of the array is not zero; empty without one
  std::int64_t vertices = 0;        ///< how many are 1
};

/// The point array `name`, or without a name the first that is called "fixed", in whatever case, if there is one. What
/// the program adds to a file to show what it held has another name (annotation_names.h), so it is not taken for the
/// user's word. Throws std::invalid_argument where `name` is given and the document has no such array, naming those it
/// has. Complexity: linear.
FixedArray find_fixed_array(const MeshDocument& document, const std::optional<std::string>& name);

}  // namespace trismooth
