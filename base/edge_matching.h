// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

class Workers;

/// What match_edges() answers for a halfedge that is not paired: MatchedSides::no_twin and many_twins.
inline constexpr std::int32_t unpaired = -1;
inline constexpr std::int32_t one_of_many = -2;

/// Finds which halfedges are on the same edge. Halfedge 3 t + i runs from corner i of triangle t to the next one;
/// `corner` is the lowest that starts at each vertex. Writes to `twins`, for each halfedge, the other one on its edge,
/// unpaired (there is none) or one_of_many: there are several, or the other one is of a triangle with the same three
/// corners. Such a copy lies upon its triangle, not beside it. Of elements with quadrilaterals among them halfedge
/// 4 t + i is that of element t; the fourth of a triangle is unpaired.
///
/// Every edge belongs to a part, by the lower of the corners of its ends: files list elements with more locality than
/// vertices, so a part's halfedges are near each other however vertices are numbered. The halfedges are sorted by their
/// parts, and met within each in a hash table that fits into the cache. Complexity: linear; takes 10 bytes a halfedge.
void match_edges(std::span<const Triangle> triangles, std::span<const std::int32_t> corner,
                 std::span<std::int32_t> twins, Workers& workers);
void match_edges(std::span<const MixedElement> elements, std::span<const std::int32_t> corner,
                 std::span<std::int32_t> twins, Workers& workers);

}  // namespace trismooth
