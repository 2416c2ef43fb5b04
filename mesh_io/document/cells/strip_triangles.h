// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Calls visit(const Triangle&) for each triangle of a triangle strip, in its order: every vertex from the third on
/// makes one with the two before it. Every second one is listed the other way round in the file, so its first two
/// vertices are exchanged here: all triangles of a flat strip turn the same way. Triangles that repeat a vertex join
/// parts of a strip and are left out.
template <class Visit>
void for_each_strip_triangle(std::span<const std::int32_t> strip, Visit visit) {
  for (std::size_t i = 2; i < strip.size(); ++i) {
    const std::size_t odd = i % 2;
    const Triangle triangle{strip[i - 2 + odd], strip[i - 1 - odd], strip[i]};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
      visit(triangle);
    }
  }
}

/// True where the document has triangle strips.
bool has_strips(const MeshDocument& document);

/// The document with the triangles of each strip in its place, each with the strip's row of the cell arrays; without an
/// original. For formats that hold triangles only. Linear.
MeshDocument with_strips_as_triangles(const MeshDocument& document);

}  // namespace trismooth
