// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/inp/inp_model.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads an input file of Abaqus or CalculiX, `bytes` being the whole of it, and the files that it includes. Nodes and
/// elements of all parts, instances and of the assembly become points and cells in the order of their lines; those of
/// a part stand in its own coordinates. Element sets that sections are assigned to become the int32 cell array
/// "abaqus:elset" with their names; where there are no sections, the sets that keyword lines of elements name; where
/// these say nothing either, sets that do not overlap. All other sets become sets of the document. Keywords that make
/// nodes or elements by rules are refused, and so are local coordinates; all else stays in the bytes that are written
/// back. Throws ReadError.
MeshDocument read_inp(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

/// The lines alone, and how they hang together.
InpModel read_inp_model(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers);

}  // namespace trismooth
