// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace trismooth {

/// Whether the path is that of the elements (.ele, in any case) of a mesh of Triangle, not of its nodes.
bool is_triangle_elements(const std::filesystem::path& path);

/// The other file of a mesh of Triangle: mesh.ele of mesh.node, and the other way round, in the same case of letters.
std::filesystem::path triangle_partner(const std::filesystem::path& path);

/// triangle_partner() of a file to write. Throws WriteError for a path that ends with neither .node nor .ele.
std::filesystem::path triangle_output_partner(const std::filesystem::path& path);

}  // namespace trismooth
