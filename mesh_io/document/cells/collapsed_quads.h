// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The triangle of a quadrilateral that repeats a corner, as Ansys and Abaqus write triangles.
struct CollapsedQuad {
  Triangle corners;                                    ///< in the order of the quadrilateral
  std::optional<std::array<std::int32_t, 3>> middles;  ///< of the sides 01, 12 and 20, where it has eight nodes
};

/// That of a quadrilateral of four or eight nodes of which two corners that follow each other are the same vertex, and
/// no other ones. Constant time.
std::optional<CollapsedQuad> triangle_of_quad(std::uint8_t type, std::span<const std::int32_t> vertices);

/// How many such quadrilaterals the document has. Linear.
std::size_t count_collapsed_quads(const MeshDocument& document);

/// The document with triangles of three or six nodes in place of such quadrilaterals; without an original. For formats
/// that do not hold them. Linear.
MeshDocument with_collapsed_quads_as_triangles(const MeshDocument& document);

}  // namespace trismooth
