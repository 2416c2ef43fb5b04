// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/msh/msh_nodes.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

namespace trismooth {

/// Bytes of a file.
struct MshSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// What writing an MSH file back needs to know of it.
struct MshLayout {
  MshHeader header;
  std::vector<MshNodeList> nodes;
  std::vector<NumberSites> data;  ///< of point arrays, in the file's order
  std::size_t nodes_begin = 0;    ///< of the line $Nodes or $ParametricNodes, and behind that of its end
  std::size_t nodes_end = 0;
  std::size_t cell_count = 0;
  MshTags node_tags;                        ///< of points, in their order
  MshTags element_tags;                     ///< of elements, in the file's order
  std::vector<std::int32_t> element_cells;  ///< of every element; empty where element i is cell i
  std::vector<std::string> field_names;     ///< of all sections of data
  std::vector<MshSpan> annotations;         ///< sections that hold annotations of an earlier run (annotation_names.h)
};

/// Reads the file; the document has no original yet. Throws ReadError.
MeshDocument read_msh(const std::filesystem::path& path, std::string_view bytes, const FileWorkers& workers,
                      MshLayout& layout);

}  // namespace trismooth
