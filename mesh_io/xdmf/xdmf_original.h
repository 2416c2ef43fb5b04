// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/xdmf/xdmf_items.h"

namespace trismooth {

/// What an XDMF file was, to be written back.
struct XdmfSource {
  std::filesystem::path path;
  FileBytes bytes;
  std::vector<XdmfHeavyFile> files;
  std::vector<XdmfFileName> names;
  std::vector<NumberSites> coordinates;  ///< in the text
  std::size_t points = 0;
};

/// Writes the XDMF file back byte by byte but for coordinates that differ, and beside it, under names led to by its
/// own, the files that have coordinates; those that have none are referred to where they are, or copied to another
/// folder.
std::shared_ptr<const OriginalFile> make_xdmf_original(XdmfSource source);

}  // namespace trismooth
