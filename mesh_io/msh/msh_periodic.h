// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

namespace trismooth {

/// Reads the section $Periodic behind its first line: the pairs of nodes that it links. A tag that no node has is there
/// as a negative number: Gmsh writes 0 for nodes that it leaves out. `nodes` are finished. Throws ReadError for what is
/// no such section. Complexity: linear in the links, but for finding nodes by their tags.
std::vector<std::array<std::int32_t, 2>> read_msh_periodic(MshInput& input, const MshTags& nodes);

}  // namespace trismooth
