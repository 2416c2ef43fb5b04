// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the file of a mesh of Triangle that the path's extension names: the nodes, or the elements. Nodes have the
/// point arrays "triangle:attribute" and "triangle:marker" of the document, elements the numbers of their groups (see
/// find_cell_groups) as an attribute, or the cell array "triangle:attribute". Elements are the document's triangles;
/// of one without any, its quadratic triangles. Throws WriteError, also for a mesh that is not flat.
void write_triangle(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// What write_triangle() leaves out, one sentence each.
std::vector<std::string> lost_in_triangle(const MeshDocument& document);

}  // namespace trismooth
