#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The cells whose type is none of `kept`, counted by type, for messages: "2 quads, 1 poly-vertex". Empty where there
/// are none.
std::string describe_other_cells(const CellList& cells, std::span<const std::uint8_t> kept);

}  // namespace trismooth
