// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

/// The vertices of an edge, the smaller number first.
using EdgeEnds = std::array<std::int32_t, 2>;

/// The edges of a mesh that people look for, each once, by ascending vertices.
struct MeshLines {
  std::vector<EdgeEnds> boundary;    ///< of one element
  std::vector<EdgeEnds> interfaces;  ///< of two elements of different regions, and of three elements or more
};

/// The lines of a picture. `threads`: 0 is all. Where it says which vertices are held, those of others are on no line.
/// Complexity: linear; memory for the edges between held vertices alone, and 16 bytes a vertex.
MeshLines mesh_lines(const MeshPicture& picture, int threads = 1);

}  // namespace trismooth
