#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/msh/msh_input.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

namespace trismooth {

/// Reads the section $Periodic behind its first line: the nodes that it links, both of each pair, ascending, each once.
/// Tags that no node has are passed over: Gmsh writes 0 for nodes that it leaves out. `nodes` are finished. Throws
/// ReadError for what is no such section. Complexity: n log n in the links.
std::vector<std::int32_t> read_msh_periodic(MshInput& input, const MshTags& nodes);

}  // namespace trismooth
