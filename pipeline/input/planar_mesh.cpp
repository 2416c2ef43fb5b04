#include "trismooth/pipeline/input/planar_mesh.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <span>

#include "trismooth/base/relaxed_atomics.h"
#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/document/strip_triangles.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/named_sides.h"

namespace trismooth {

namespace {

constexpr std::int64_t cell_grain = 8192;

bool is_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 3 && (type == cell_type::triangle || type == cell_type::polygon);
}

bool is_quadratic(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 6 && type == cell_type::quadratic_triangle;
}

bool repeats_a_vertex(std::span<const std::int32_t> triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Adds the triangles of a strip; false where it has none.
bool add_strip(std::span<const std::int32_t> strip, std::size_t cell, PlanarMesh& mesh) {
  for_each_strip_triangle(strip, [&](const Triangle& triangle) { mesh.triangles_of_cells.push_back(triangle); });
  const bool has_triangles = mesh.cells.size() < mesh.triangles_of_cells.size();
  mesh.cells.resize(mesh.triangles_of_cells.size(), static_cast<std::int32_t>(cell));
  return has_triangles;
}

/// Takes the cells of a document that has triangles alone, as they lie there; false, and nothing is taken, where it has
/// others.
bool take_triangles(const CellList& cells, PlanarMesh& mesh, Workers& workers) {
  if (cells.connectivity.size() != 3 * cells.size()) {
    return false;
  }
  const std::int64_t count = std::ssize(cells.types);
  mesh.cells.resize(cells.size());
  std::atomic<bool> has_others{false};
  workers.for_blocks(count, cell_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t c = begin; c < end; ++c) {
      const std::int32_t* const vertices = cells.connectivity.data() + 3 * c;
      if (cells.offsets[c + 1] != 3 * (c + 1) || !is_triangle(cells.types[c], {vertices, 3}) ||
          repeats_a_vertex({vertices, 3})) {
        has_others = true;
        return;
      }
      mesh.cells[c] = static_cast<std::int32_t>(c);
    }
  });
  if (has_others) {
    mesh.cells.clear();
    return false;
  }
  static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t) && alignof(Triangle) == alignof(std::int32_t));
  mesh.triangles = {reinterpret_cast<const Triangle*>(cells.connectivity.data()), cells.size()};
  return true;
}

void sort_cells(const MeshDocument& document, PlanarMesh& mesh, Workers& workers) {
  std::size_t first_repeating = 0;
  mesh.in_other_cell.assign(document.point_count(), 0);
  mesh.in_cell.assign(document.point_count(), 0);
  const std::vector<std::int32_t>& connectivity = document.cells.connectivity;
  workers.for_blocks(std::ssize(connectivity), 3 * cell_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      set_bits_relaxed(mesh.in_cell[static_cast<std::size_t>(connectivity[i])], 1);
    }
  });
  if (take_triangles(document.cells, mesh, workers)) {
    return;
  }
  mesh.triangles_of_cells.reserve(document.cells.size());
  mesh.cells.reserve(document.cells.size());
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const auto vertices = document.cells[c];
    if (document.cells.types[c] == cell_type::triangle_strip && add_strip(vertices, c, mesh)) {
      continue;
    }
    const bool quadratic = is_quadratic(document.cells.types[c], vertices);
    const bool triangular = quadratic || is_triangle(document.cells.types[c], vertices);
    if (triangular && !repeats_a_vertex(vertices)) {
      if (quadratic) {
        mesh.quadratics.push_back(
            {static_cast<std::int32_t>(mesh.triangles_of_cells.size()), {vertices[3], vertices[4], vertices[5]}});
      }
      mesh.triangles_of_cells.push_back({vertices[0], vertices[1], vertices[2]});
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
  mesh.triangles = mesh.triangles_of_cells;
  mesh.notes = notes_of_other_cells(mesh.other_cells, mesh.repeating_triangles, first_repeating);
}

/// Named boundaries hold their vertices as line cells do.
void hold_named_sides(const MeshDocument& document, PlanarMesh& mesh) {
  const NamedSides sides = find_named_sides(document, mesh);
  for (const std::int32_t v : sides.lines) {
    mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
  }
  if (sides.count() > 0) {
    mesh.notes.push_back("named boundaries on sides of triangles (" + sides.names + "; " +
                         counted(sides.count(), "side") + "): their vertices are held, or slide along them with --slide");
  }
}

void lay_into_plane(PlanarMesh& mesh, const PlaneFit& fit, const MeshDocument& document,
                    const std::filesystem::path& path, Workers& workers) {
  if (!fit.is_planar()) {
    throw ReadError(
        path,
        fit.fault() + "; only planar meshes can be smoothed, or where z is a function of x and y with --project xy");
  }
  auto points = project(fit.plane, document.points, mesh.in_cell, workers);
  if (!points) {
    throw ReadError(path,
                    "the mesh is too large: coordinates along its tilted plane are beyond the range of double; "
                    "scale it down");
  }
  mesh.plane = fit.plane;
  mesh.points = *std::move(points);
}

/// Without a plane.
PlanarMesh sorted_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers) {
  check_document_size(document.point_count(), document.cells.size(), path);
  PlanarMesh mesh;
  sort_cells(document, mesh, workers);
  hold_named_sides(document, mesh);
  require_triangles(std::ssize(mesh.triangles), static_cast<std::int64_t>(document.cells.size()), path);
  if (mesh.triangles.empty()) {
    mesh.notes.emplace_back("the file holds no cells: nothing to smooth");
  }
  return mesh;
}

}  // namespace

std::int64_t count_triangles(std::uint8_t type, std::span<const std::int32_t> vertices) {
  if (type == cell_type::triangle_strip) {
    std::int64_t count = 0;
    for_each_strip_triangle(vertices, [&count](const Triangle&) { ++count; });
    return count;
  }
  return (is_triangle(type, vertices) || is_quadratic(type, vertices)) && !repeats_a_vertex(vertices) ? 1 : 0;
}

void require_triangles(std::int64_t triangles, std::int64_t cells, const std::filesystem::path& path) {
  if (triangles == 0 && cells > 0) {
    throw ReadError(path, "holds " + counted(cells, "cell") + " but no triangle; only triangle meshes can be smoothed");
  }
}

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

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers) {
  PlanarMesh mesh = sorted_mesh(document, path, workers);
  lay_into_plane(mesh, fit_plane(document.points, mesh.in_cell, document.cells, storage_of(document), workers),
                 document, path, workers);
  return mesh;
}

PlanarMesh projected_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers) {
  PlanarMesh mesh = sorted_mesh(document, path, workers);
  lay_into_plane(mesh, {}, document, path, workers);
  return mesh;
}

PlanarMesh mesh_of_piece(const MeshDocument& document, const std::filesystem::path& path, Workers& workers) {
  check_document_size(document.point_count(), document.cells.size(), path);
  PlanarMesh mesh;
  sort_cells(document, mesh, workers);
  hold_named_sides(document, mesh);
  mesh.notes.clear();
  lay_into_plane(mesh, {}, document, path, workers);
  return mesh;
}

std::vector<std::string> notes_of_other_cells(std::int64_t other_cells, std::int64_t repeating_triangles,
                                              std::optional<std::size_t> first_repeating) {
  std::vector<std::string> notes;
  if (repeating_triangles > 0) {
    notes.push_back(
        counted(repeating_triangles, "triangle") + " repeating a vertex" +
        (first_repeating ? " (the first is cell " + std::to_string(*first_repeating) + ")" : std::string()) +
        ": kept as they are, their vertices held fixed");
  }
  if (other_cells > repeating_triangles) {
    notes.push_back(counted(other_cells - repeating_triangles, "cell") +
                    " of other types than triangle: kept as they are, their vertices held fixed");
  }
  return notes;
}

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path) {
  Workers one(1);
  return planar_mesh(document, path, one);
}

bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path, Workers& workers) {
  const auto fit = plane_of_fixed(mesh.plane, document.points, mesh.in_cell, fixed, storage_of(document));
  if (fit) {
    lay_into_plane(mesh, *fit, document, path, workers);
  }
  return fit.has_value();
}

}  // namespace trismooth
