#include "trismooth/base/mesh_size.h"

#include <limits>

#include "trismooth/base/errors.h"

namespace trismooth {

void check_mesh_size(std::int64_t vertex_count, std::int64_t triangle_count) {
  if (vertex_count < 0) {
    throw MeshError("the number of vertices is negative");
  }
  if (vertex_count > std::numeric_limits<std::int32_t>::max()) {
    throw MeshError("more than 2147483647 vertices");
  }
  if (triangle_count < 0) {
    throw MeshError("the number of triangles is negative");
  }
  if (triangle_count > std::numeric_limits<std::int32_t>::max() / 3) {
    throw MeshError("more than 715827882 triangles");
  }
}

void throw_no_such_vertex(std::int64_t triangle, const std::string& vertex, std::int64_t vertex_count) {
  throw MeshError("triangle " + std::to_string(triangle) + " names vertex " + vertex + " of " +
                  std::to_string(vertex_count));
}

}  // namespace trismooth
