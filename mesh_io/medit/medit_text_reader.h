// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/medit/medit_mesh.h"

namespace trismooth {

/// Reads a Medit file that is text (.mesh), `bytes` being the whole of it: keywords in any case of letters, each with
/// its count and rows, in any order; comments from # on. Sections of other keywords are passed over up to the next
/// word. Rows of plain numbers are read in parts, by all workers. Throws ReadError. Linear in the file's size.
MeditMesh read_medit_text(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers);

}  // namespace trismooth
