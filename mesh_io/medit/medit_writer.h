// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Writes the document as a Medit file to the plain path: binary where its extension is .meshb, else text. Version 2,
/// or higher where the numbers or the size of a binary file need it. Throws WriteError.
void write_medit(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers);

/// write_medit() of a document that was read from a Medit file: with all its cells. Throws WriteError.
void write_medit_in_other_encoding(const std::filesystem::path& path, const MeshDocument& document,
                                   const FileWorkers& workers);

}  // namespace trismooth
