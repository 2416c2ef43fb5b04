// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "trismooth/mesh_io/mesh_document.h"

/// The mesh files that benchmarks read. A kind is an extension of a format that is written ("off", "vtu": raw), or
/// "msh-binary" (MSH 4.1, as Gmsh writes it), "msh2" (MSH 2.2 as text) or "freefem", whose files have that extension
/// here.
namespace mesh_files {

/// Where a file of that kind is in the folder: `name`, and the extension.
std::filesystem::path path_of(const std::filesystem::path& folder, const std::string& name, const std::string& kind);

/// Writes the triangles of a document that has nothing else. Throws WriteError.
void write(const std::filesystem::path& path, const std::string& kind, const trismooth::MeshDocument& triangles);

}  // namespace mesh_files
