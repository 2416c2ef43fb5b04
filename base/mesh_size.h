#pragma once

#include <cstdint>
#include <string>

namespace trismooth {

/// Throws MeshError for a negative number of vertices or triangles, for more than 2,147,483,647 vertices and for more
/// than 715,827,882 triangles: their corners are numbered with 32 bits. For counts as they come, before they are
/// narrowed and before memory is taken.
void check_mesh_size(std::int64_t vertex_count, std::int64_t triangle_count);

/// Throws the MeshError for a triangle with a vertex number out of range.
[[noreturn]] void throw_no_such_vertex(std::int64_t triangle, const std::string& vertex, std::int64_t vertex_count);

}  // namespace trismooth
