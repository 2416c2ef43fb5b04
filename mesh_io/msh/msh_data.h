// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/mesh_io/msh/msh_elements.h"
#include "trismooth/mesh_io/msh/msh_nodes.h"

namespace trismooth {

/// A section $NodeData or $ElementData: a number, or several, for nodes or elements.
struct MshDataSection {
  bool of_nodes = false;
  std::string name{};  ///< the first of its texts
  std::size_t components = 0;
  std::size_t rows = 0;
  std::size_t begin = 0;  ///< of the rows, in the file
};

/// Reads what stands before the rows of a data section, behind its first line. False where it does not say what the
/// rows are.
bool read_msh_data_header(MshInput& input, MshDataSection& section);

/// Reads the rows, once nodes and elements are known: an array of the document, `sites` where it is of nodes. Data that
/// are not of all nodes or cells stay in the file, and a note says so.
void read_msh_data(MshInput& input, MshRows& rows, const MshDataSection& section, const MshNodes& nodes,
                   const MshElements& elements, FreeNames& names, MeshDocument& document,
                   std::vector<NumberSites>& sites);

}  // namespace trismooth
