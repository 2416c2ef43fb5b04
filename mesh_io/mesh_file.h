// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// How read_mesh() and write_mesh() go about a file.
struct FileOptions {
  /// That read and decode, or encode and write, in parts, where the file is large enough for that; 0: one for each
  /// core. Documents, bytes and errors are the same for every number of them.
  int threads = 1;
  /// Of standard streams, and of files whose extension names no format.
  std::optional<FileFormat> format;
};

/// Reads a mesh file. Nothing is interpreted. `-` is standard input.
/// Its extension and its content choose the format: one that the extension names and that is the file's by its content
/// as well, as far as that shows it; else the only other one that the content is of, which a note of the document says
/// then. Files that gzip has compressed are read, too, whatever their name; the extension is that in front of ".gz".
/// Throws ReadError for a file of no known format or of one that is not available in this build, one that is
/// unreadable or compressed otherwise, or one that breaks its format's rules, with the place in the file. Counts and
/// indices are checked against the file's size before anything is allocated. Complexity: linear in the file's size.
/// Throws std::invalid_argument for a number of threads out of range.
MeshDocument read_mesh(const std::filesystem::path& path, const FileOptions& options);

/// read_mesh() on that many threads, of the format that path and content say.
MeshDocument read_mesh(const std::filesystem::path& path, int threads = 1);

/// Arrays to add to what a document holds, where the target takes_added_arrays(). Where any is added, annotations of an
/// earlier run (see annotation_names.h) that the document holds are left out: what they show is no more.
struct AddedArrays {
  std::vector<DataArray> point_arrays;
  std::vector<DataArray> cell_arrays;
};

/// Writes the document to `path`, as its output_format(). In the format that it was read from, the output
/// is the input with the coordinates that changed and nothing else; in another, all that the target can hold (see
/// what_is_lost). The file is written beside the target, flushed and renamed over it: whatever stood there survives
/// any failure. A target that is not a regular file (a device, a pipe) is written directly, and so is `-`, standard
/// output. Where the last extension is ".gz", what is written is compressed, by gzip at level 6, without a name and a
/// time: the same mesh gives the same bytes.
/// Throws WriteError, also where there is no output_format(), where an array has not a row for every point or cell, and
/// for a document that require_sound() refuses.
void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added,
                const FileOptions& options);

/// write_mesh() on that many threads, in the format that the path and the document say.
void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added = {},
                int threads = 1);

/// True where write_mesh() adds arrays to the document in that format: those that have_arrays(), and PLY, as
/// properties; but where the document's own file is written back whose original takes none (PLY, MSH of version 1).
bool takes_added_arrays(const MeshDocument& document, FileFormat target);

/// True where write_mesh() writes the values that the document has of that point array, if the format has it: always,
/// but where the document's own file is written back whose original keeps those that were read (see OriginalFile).
bool writes_values_of(const MeshDocument& document, FileFormat target, std::string_view point_array);

/// The first format that the extension of `path` names: what read_mesh() reads it as, unless its content is of
/// another. Throws ReadError for an extension that is unknown or not available in this build.
FileFormat input_format(const std::filesystem::path& path);

/// The format that write_mesh() writes to `path`: of those that its extension names, `of_document`, the format that the
/// document was read from, or else the first. Where it names none `told`, and for `-` else `of_document`. Throws
/// WriteError for an extension that is unknown or not available in this build: to find that out before the work is
/// done.
FileFormat output_format(const std::filesystem::path& path, std::optional<FileFormat> of_document = std::nullopt,
                         std::optional<FileFormat> told = std::nullopt);

/// What `target` cannot hold of the document, one sentence each ("OFF holds no cell arrays: region is not written");
/// empty where nothing is lost, as always where `target` is the format that the document was read from. The
/// document's own losses, and what it notes as kept in its format only, come on top. `target` is available.
std::vector<std::string> what_is_lost(const MeshDocument& document, FileFormat target);

}  // namespace trismooth
