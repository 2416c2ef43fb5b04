// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The arrays that are written of a document: its own, and behind them its sets as arrays of 0 and 1, which every
/// reader of XDMF takes (<Set> stops meshio).
struct XdmfWrittenArrays {
  std::vector<DataArray> of_points;
  std::vector<DataArray> of_cells;
};

/// The document's own arrays are shared.
XdmfWrittenArrays xdmf_written_arrays(const MeshDocument& document);

/// The names of values of the document's arrays, and of its sets among `arrays`, as meshio reads them from an
/// <Information>: <main><map key="NAME" dim="2" array="ARRAY">7</map></main>. Empty where there are none.
std::string xdmf_names(const MeshDocument& document, const XdmfWrittenArrays& arrays);

/// Gives the document the names that `content` has of its arrays, and the sets, whose arrays go. Names of no array, as
/// meshio has them, are those of "gmsh:physical". Content of another kind, for an <Information> may be anything, and
/// names of arrays that are not there are left alone.
void add_xdmf_names(const std::filesystem::path& file, std::string_view content, MeshDocument& document);

}  // namespace trismooth
