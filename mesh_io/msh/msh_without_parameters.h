// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/msh/msh_reader.h"

namespace trismooth {

/// The file without the parametric coordinates of the lists of nodes for which `left_out` is true; the nodes are ones
/// without then. Before version 4, where all nodes are in one section, without those of all nodes.
std::string without_msh_parameters(std::string_view bytes, const MshLayout& layout, const std::vector<bool>& left_out);

}  // namespace trismooth
