// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// What the names of annotations begin with: the arrays that this program adds to a file to show what it found and did.
/// The prefix tells them from a file's own arrays (its `shape` or `fixed` is the user's, and stays), so that a later
/// run does not take them for input and replaces them by its own. As `gmsh:physical` and `medit:ref` name their makers.
inline constexpr std::string_view annotation_prefix = "trismooth:";

/// Whether an array of that name is an annotation.
constexpr bool is_annotation(std::string_view array_name) {
  return array_name.starts_with(annotation_prefix);
}

/// The name of the annotation that shows `what`: annotation_name("shape") is "trismooth:shape".
inline std::string annotation_name(std::string_view what) {
  return std::string(annotation_prefix).append(what);
}

}  // namespace trismooth
