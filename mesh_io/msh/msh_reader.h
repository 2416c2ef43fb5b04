#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/msh/msh_nodes.h"

namespace trismooth {

/// What writing an MSH file back needs to know of it.
struct MshLayout {
  MshHeader header;
  std::vector<MshNodeList> nodes;
  std::vector<NumberSites> data;  ///< of point arrays, in the file's order
  std::size_t nodes_begin = 0;    ///< of the line $Nodes or $ParametricNodes, and behind that of its end
  std::size_t nodes_end = 0;
  std::size_t cell_count = 0;
};

/// Reads the file; the document has no original yet. Throws ReadError.
MeshDocument read_msh(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers,
                      MshLayout& layout);

}  // namespace trismooth
