#pragma once

#include <memory>
#include <string>

#include "trismooth/mesh_io/coordinate_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// An original file of a format that states each coordinate in place: it keeps the file's `bytes` and writes them back
/// with the coordinates at `sites` patched (see write_patched). Its write() throws WriteError where arrays are to be
/// added or where the document has another number of points than the file.
std::shared_ptr<const OriginalFile> make_patched_original(std::string bytes, CoordinateSites sites);

}  // namespace trismooth
