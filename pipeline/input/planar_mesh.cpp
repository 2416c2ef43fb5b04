#include "trismooth/pipeline/input/planar_mesh.h"

#include <cmath>
#include <limits>
#include <span>

#include "trismooth/mesh_io/document/strip_triangles.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

bool is_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 3 && (type == cell_type::triangle || type == cell_type::polygon);
}

bool repeats_a_vertex(std::span<const std::int32_t> triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Adds the triangles of a strip; false where it has none.
bool add_strip(std::span<const std::int32_t> strip, std::size_t cell, PlanarMesh& mesh) {
  for_each_strip_triangle(strip, [&](const Triangle& triangle) { mesh.triangles.push_back(triangle); });
  const bool has_triangles = mesh.cells.size() < mesh.triangles.size();
  mesh.cells.resize(mesh.triangles.size(), static_cast<std::int32_t>(cell));
  return has_triangles;
}

void sort_cells(const MeshDocument& document, PlanarMesh& mesh) {
  std::size_t first_repeating = 0;
  mesh.in_other_cell.assign(document.point_count(), 0);
  mesh.in_cell.assign(document.point_count(), 0);
  for (const std::int32_t v : document.cells.connectivity) {
    mesh.in_cell[static_cast<std::size_t>(v)] = 1;
  }
  mesh.triangles.reserve(document.cells.size());
  mesh.cells.reserve(document.cells.size());
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto vertices = document.cells[c];
    if (document.cells.types[c] == cell_type::triangle_strip && add_strip(vertices, c, mesh)) {
      continue;
    }
    const bool triangular = is_triangle(document.cells.types[c], vertices);
    if (triangular && !repeats_a_vertex(vertices)) {
      mesh.triangles.push_back({vertices[0], vertices[1], vertices[2]});
      mesh.cells.push_back(static_cast<std::int32_t>(c));
      continue;
    }
    if (triangular && mesh.repeating_triangles++ == 0) {
      first_repeating = c;
    }
    ++mesh.other_cells;
    for (const std::int32_t v : vertices) {
      mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
    }
  }
  if (mesh.repeating_triangles > 0) {
    mesh.notes.push_back(counted(mesh.repeating_triangles, "triangle") + " repeating a vertex (the first is cell " +
                         std::to_string(first_repeating) + "): kept as they are, their vertices held fixed");
  }
  if (mesh.other_cells > mesh.repeating_triangles) {
    mesh.notes.push_back(counted(mesh.other_cells - mesh.repeating_triangles, "cell") +
                         " of other types than triangle: kept as they are, their vertices held fixed");
  }
}

void lay_into_plane(PlanarMesh& mesh, const PlaneFit& fit, const MeshDocument& document,
                    const std::filesystem::path& path) {
  if (!fit.is_planar()) {
    throw ReadError(path, fit.fault() + "; only planar meshes can be smoothed");
  }
  auto points = project(fit.plane, document.points, mesh.in_cell);
  if (!points) {
    throw ReadError(path,
                    "the mesh is too large: coordinates along its tilted plane are beyond the range of double; "
                    "scale it down");
  }
  mesh.plane = fit.plane;
  mesh.points = *std::move(points);
}

}  // namespace

Storage storage_of(const MeshDocument& document) {
  return document.moved_point_type() == ScalarType::float32 ? Storage::float32 : Storage::float64;
}

void check_document_size(std::size_t points, std::size_t cells, const std::filesystem::path& path) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (points > most) {
    throw ReadError(path, "holds more than " + std::to_string(most) + " vertices");
  }
  if (cells > most) {
    throw ReadError(path, "holds more than " + std::to_string(most) + " cells");
  }
}

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path) {
  check_document_size(document.point_count(), document.cells.size(), path);
  PlanarMesh mesh;
  sort_cells(document, mesh);
  if (mesh.triangles.empty() && document.cells.size() > 0) {
    throw ReadError(path, "holds " + counted(static_cast<std::int64_t>(document.cells.size()), "cell") +
                              " but no triangle; only triangle meshes can be smoothed");
  }
  if (mesh.triangles.empty()) {
    mesh.notes.emplace_back("the file holds no cells: nothing to smooth");
  }
  lay_into_plane(mesh, fit_plane(document.points, mesh.in_cell, document.cells, storage_of(document)), document, path);
  return mesh;
}

bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path) {
  const auto fit = plane_of_fixed(mesh.plane, document.points, mesh.in_cell, fixed, storage_of(document));
  if (fit) {
    lay_into_plane(mesh, *fit, document, path);
  }
  return fit.has_value();
}

}  // namespace trismooth
