#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace trismooth {

struct PlanarMesh;

/// A node in the middle of a side of quadratic triangles: it moves by the mean of what the side's ends move.
struct MiddleNode {
  std::int32_t vertex = 0;
  std::array<std::int32_t, 2> ends{};
};

/// Tells which middles of the mesh's quadratic triangles follow their sides (mesh.middles), and holds where it cannot
/// be: a middle of two different sides, one that is a corner as well, of a line or of any other cell, or that `named`
/// holds (a byte a vertex, or empty: none is) has to stay, and so have the ends of its sides: in `named`, where it is
/// named, else in mesh.in_other_cell. Complexity: linear.
void settle_middles(PlanarMesh& mesh, std::vector<std::uint8_t>& named);

}  // namespace trismooth
