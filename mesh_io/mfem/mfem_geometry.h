// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "trismooth/base/cell_list.h"

namespace trismooth {

/// An element of MFEM: its number in the file is its place in mfem_geometries.
struct MfemGeometry {
  std::uint8_t cell;  ///< VTK's type, whose vertices have the same order
  std::size_t vertices;
};

/// Point, segment, triangle, square, tetrahedron, cube, prism, pyramid (https://mfem.org/mesh-formats/).
inline constexpr std::array<MfemGeometry, 8> mfem_geometries{{{cell_type::vertex, 1},
                                                              {cell_type::line, 2},
                                                              {cell_type::triangle, 3},
                                                              {cell_type::quad, 4},
                                                              {cell_type::tetrahedron, 4},
                                                              {cell_type::hexahedron, 8},
                                                              {cell_type::wedge, 6},
                                                              {cell_type::pyramid, 5}}};

}  // namespace trismooth
