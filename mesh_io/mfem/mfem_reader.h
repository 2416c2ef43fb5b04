// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an MFEM mesh v1.0, v1.1, v1.2 or v1.3 (https://mfem.org/mesh-formats/). The attributes of elements and of the
/// boundary are the cell array "mfem:attribute"; a named set of one attribute names it, other sets are sets of cells.
/// The points are the vertices, also where a grid function `nodes` of degree 1 has their places; where it is of degree
/// 2, the middles of edges and quadrilaterals follow them (see mfem_nodes.h), and cells are of six nodes, nine and
/// three. Throws ReadError, also for `nodes` of higher degrees or of other spaces, for periodic meshes, in which a
/// vertex has several places, and for non-conforming ones.
MeshDocument read_mfem(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth
