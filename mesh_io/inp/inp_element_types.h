// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trismooth {

/// What an element type of Abaqus or CalculiX is.
struct InpElementType {
  std::uint8_t cell = 0;  ///< its cell_type; 0 where the type is not known
  std::size_t nodes = 0;  ///< of an element; 0 where the type is not known

  bool is_known() const { return nodes > 0; }
};

/// The type of that name (in upper case): by the family that it begins with and the number of nodes behind that, so
/// that all variants are known (CPS3, CPE4R, S8R5, CAX6MH, ...).
InpElementType inp_element_type(std::string_view name);

/// Whether elements of that type (in upper case) join two faces: cohesive ones and gaskets. Their thickness, which may
/// be none, is part of the model.
bool joins_faces(std::string_view name);

/// The element type that is written for cells of that type: plane stress, trusses and solids, as Gmsh writes them;
/// empty where there is none.
std::string_view inp_type_of_cell(std::uint8_t cell);

}  // namespace trismooth
