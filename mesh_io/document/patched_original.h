#pragma once

#include <memory>

#include "trismooth/mesh_io/bytes/file_bytes.h"
#include "trismooth/mesh_io/document/coordinate_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The original of a format that is written back byte by byte: `bytes`, the whole file, with the coordinates at
/// `sites` replaced where they differ (see write_patched). Such formats hold no named arrays: its write() throws
/// WriteError where arrays are to be added, and where the document does not have one point for every vertex of the
/// sites.
std::shared_ptr<const OriginalFile> make_patched_original(FileBytes bytes, CoordinateSites sites);

}  // namespace trismooth
