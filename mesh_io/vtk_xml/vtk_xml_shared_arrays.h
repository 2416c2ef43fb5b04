// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/vtk_xml/vtk_xml_pieces.h"

namespace trismooth {

/// The arrays of a section (<PointData>, <CellData>) that every piece with rows has.
struct VtkXmlSharedArrays {
  const XmlElement* first_section = nullptr;             ///< that of the first piece with rows, else of the first piece
  std::vector<const XmlElement*> of_first;               ///< the arrays in it, in its order
  std::vector<std::vector<const XmlElement*>> of_piece;  ///< the same arrays of each piece; none where it has no rows
};

/// Arrays are the same where name, type and number of components are; of several of one name, the first is that of the
/// first and so on. Pieces without rows may leave their arrays out. What one piece has and another lacks belongs to no
/// joined mesh (VTK drops it, too): it gives a sentence in `losses`. Throws ReadError for an array without a name.
/// Complexity: n log n in the number of arrays.
VtkXmlSharedArrays find_shared_arrays(const std::filesystem::path& path, std::span<const VtkXmlPiece> pieces,
                                      const std::string& section, std::uint64_t VtkXmlPiece::*rows,
                                      std::vector<std::string>& losses);

}  // namespace trismooth
