// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// Whether a point array may have markers: by its name (is_marker_name()), and whole numbers, one a point.
bool may_be_markers(std::string_view name, ScalarType type, std::uint64_t components);

/// Of each vertex inside the mesh, of one region alone and not held anyway: the number of its region; of the others -1.
/// `regions`: a number from 0 an element; empty: the mesh is one region. `is_held`: a flag a vertex. A vertex is inside
/// where each neighbour along a side is in two of its elements, which is told by sums of scattered numbers: of 2^64
/// vertices on the boundary one would count as inside. Complexity: linear.
std::vector<std::int32_t> find_regions_inside(const ElementList& elements, std::span<const std::int32_t> regions,
                                              std::span<const std::uint8_t> is_held);

/// The vertices that an array of markers marks, ascending, and how many more inside have another marker than what
/// surrounds.
struct MarkedPoints {
  std::vector<std::int32_t> vertices;
  std::int64_t others = 0;
};

/// The vertices inside that carry a marker other than what surrounds them: electrodes, points and segments that a mesh
/// generator was told to respect. The vertices inside a region that have the same marker are a group. What surrounds
/// are those of marker 0, with which programs say nothing, or in a region that has none the largest group, and besides
/// each group that is an area: more than one of its vertices, and more than a sixth of them, have neighbours of the
/// group only. All others are marked, if they are a third of the vertices inside the region at most, or two fifths
/// at most and on curves: with fewer than 6 edges between 5 of them. Else the markers are numbers or the like, and mark
/// nothing there.
///
/// `markers`: numbers from 0 that are equal where the markers of vertices are; `zero`: that of the marker 0, or -1.
/// `regions_inside`: find_regions_inside(). This is the one judge, of the program and of the Python package.
/// Complexity: linear.
MarkedPoints find_marked_points(const ElementList& elements, std::span<const std::int32_t> markers, std::int32_t zero,
                                std::span<const std::int32_t> regions_inside);

/// What the user should know of what the array marks, one sentence each. `ids`: what holds other vertices, "a file of
/// --fixed-ids".
std::vector<std::string> notes_of_marked_points(const std::string& array, const MarkedPoints& points,
                                                const std::string& ids);

}  // namespace trismooth
