// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trismooth {

/// Throws MeshError for a negative number of vertices or elements, for more than 2,147,483,647 vertices and for more
/// than 715,827,882 triangles: their corners are numbered with 32 bits. `corners`: an element, 3, or 4 where
/// quadrilaterals are among them, of which 536,870,911 fit. For counts as they come, before they are narrowed and
/// before memory is taken.
void check_mesh_size(std::int64_t vertex_count, std::int64_t element_count, int corners = 3);

/// Throws std::invalid_argument unless there is one of the `points` for each of the vertices. `components`: that each
/// of them has, for the hint that pairs may be x, y and z in turn.
void require_a_point_a_vertex(std::size_t points, std::size_t components, std::int64_t vertex_count);

/// "; vertices are numbered from 0 to 4": how the complaint about a vertex number goes on.
std::string numbering_text(std::int64_t vertex_count);

/// Throws the MeshError for an element with a vertex number out of range. `name`: what it is called.
[[noreturn]] void throw_no_such_vertex(std::int64_t element, const std::string& vertex, std::int64_t vertex_count,
                                       std::string_view name = "triangle");

/// "element 3 has 5 nodes before the first -1: ...": the complaint about a row of ElementNodes that is no element.
std::string no_element_text(std::size_t element, std::size_t nodes);

}  // namespace trismooth
