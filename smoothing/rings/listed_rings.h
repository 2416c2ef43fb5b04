// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;

/// The one-rings of a mesh as its triangles are listed, which is all there is to know of its connectivity where they
/// are listed alike and form one fan around each vertex, as those of nearly all meshes do.
struct ListedRings {
  TriangleComponents components;   ///< of parity 0
  std::vector<std::uint8_t> hold;  ///< per vertex: bits boundary, isolated
  OneRings rings;                  ///< of the vertices whose `hold` is 0, in the direction of the list
};

/// Finds them from the triangles around each vertex alone, without matching the sides of triangles, in about a third of
/// the time. None where something is not as it has to be for that (see ListedRings), or a vertex has more than
/// most_rim_edges triangles; also where a triangle is faulty: connect_triangles() says how. Complexity: linear; takes
/// 36 bytes a triangle on the way, of large meshes a quarter of that.
std::optional<ListedRings> find_listed_rings(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                             Workers& workers);

/// What connect_triangles() finds, in every number, of such meshes: the triangles around a vertex know their neighbours
/// there. None where find_listed_rings() gives none. Complexity: linear; takes 48 bytes a triangle on the way, of large
/// meshes a quarter of that.
std::optional<TriangleTopology> find_listed_topology(std::int32_t vertex_count, std::span<const Triangle> triangles,
                                                     Workers& workers);

}  // namespace trismooth
