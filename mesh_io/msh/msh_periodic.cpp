// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_periodic.h"

namespace trismooth {

namespace {

/// Passes the transformation from one side to the other. From 4.1 on its numbers are counted; before, they are a line
/// that may be missing.
void pass_affine_map(MshInput& input) {
  if (input.header().version >= 41) {
    constexpr std::int64_t most_numbers = 1000;
    for (std::int64_t left = input.size("how many numbers a transformation has", most_numbers); left > 0; --left) {
      input.real("a number of a transformation");
    }
  } else if (input.text().peek_token() == "Affine") {
    input.text().next_token("Affine");
    input.text().next_line();
  }
}

}  // namespace

std::vector<std::array<std::int32_t, 2>> read_msh_periodic(MshInput& input, const MshTags& nodes) {
  // Before 4.1 the section is text in binary files too.
  const bool of_4_1 = input.header().version >= 41;
  const auto size = [&](std::string_view what) {
    return of_4_1 ? input.size(what) : input.text().next_integer(what, 0, largest_msh_int);
  };
  std::vector<std::array<std::int32_t, 2>> found;
  for (std::int64_t links = size("the number of periodic links"); links > 0; --links) {
    for (int number = 0; number < 3; ++number) {
      constexpr std::string_view what = "a dimension or a tag of an entity";
      of_4_1 ? input.integer(what, -largest_msh_int, largest_msh_int)
             : input.text().next_integer(what, -largest_msh_int, largest_msh_int);
    }
    pass_affine_map(input);
    for (std::int64_t pairs = size("the number of linked nodes"); pairs > 0; --pairs) {
      const std::int64_t first = nodes.find(size("the tag of a node"));
      const std::int64_t second = nodes.find(size("the tag of a node"));
      found.push_back({static_cast<std::int32_t>(first), static_cast<std::int32_t>(second)});
    }
  }
  return found;
}

}  // namespace trismooth
