#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Reads a mesh file; its extension chooses the format. Nothing is interpreted.
/// Throws ReadError for an extension that is unknown or not available in this build, a compressed or unreadable file,
/// or one that breaks its format's rules, with the place in the file. Counts and indices are checked against the file's
/// size before anything is allocated. Complexity: linear in the file's size.
/// `threads` read the file and decode it in parts, where it is large enough for that; 0: one for each core. The
/// document and every error are the same for every number of them. Throws std::invalid_argument for a number out of
/// range.
MeshDocument read_mesh(const std::filesystem::path& path, int threads = 1);

/// Arrays to add to what a document holds, where the target takes_added_arrays(). Where any is added, annotations of an
/// earlier run (see annotation_names.h) that the document holds are left out: what they show is no more.
struct AddedArrays {
  std::vector<DataArray> point_arrays;
  std::vector<DataArray> cell_arrays;
};

/// Writes the document to `path`; its extension chooses the format. In the format that it was read from, the output
/// is the input with the coordinates that changed and nothing else; in another, all that the target can hold (see
/// what_is_lost). The file is written beside the target, flushed and renamed over it: whatever stood there survives
/// any failure. A target that is not a regular file (a device, a pipe) is written directly.
/// Throws WriteError, also for such an extension, and where an array has not a row for every point or cell.
/// `threads`, as of read_mesh(), encode the document; the bytes are the same for every number of them.
void write_mesh(const std::filesystem::path& path, const MeshDocument& document, const AddedArrays& added = {},
                int threads = 1);

/// True where write_mesh() adds arrays to the document in that format: those that have_arrays(), and PLY, as
/// properties, unless the document was read from PLY (its bytes are written back then).
bool takes_added_arrays(const MeshDocument& document, FileFormat target);

/// The format that read_mesh() would read `path` as. Throws ReadError for an extension that is unknown or not available
/// in this build.
FileFormat input_format(const std::filesystem::path& path);

/// The format that write_mesh() would write to `path`. Throws WriteError for an extension that is unknown or not
/// available in this build: to find that out before the work is done.
FileFormat output_format(const std::filesystem::path& path);

/// What `target` cannot hold of the document, one sentence each ("OFF holds no cell arrays: region is not written");
/// empty where nothing is lost, as always where `target` is the format that the document was read from. The
/// document's own losses, and what it notes as kept in its format only, come on top. `target` is available.
std::vector<std::string> what_is_lost(const MeshDocument& document, FileFormat target);

}  // namespace trismooth
