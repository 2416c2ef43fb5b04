// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/planar_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

/// Of VTK's cells; of types that are not known nothing is said.
constexpr bool is_solid(std::uint8_t type) {
  return (type >= cell_type::tetrahedron && type <= 16) ||
         (type >= cell_type::quadratic_tetrahedron && type <= cell_type::triquadratic_hexahedron &&
          type != cell_type::biquadratic_quad) ||
         (type >= 31 && type <= 33) || type == 37 || type == cell_type::convex_point_set || type == 42 ||
         (type >= cell_type::lagrange_tetrahedron && type <= cell_type::lagrange_pyramid) || (type >= 78 && type <= 81);
}

/// Throws ReadError where the mesh has solid cells: "holds 770 tetrahedra and 12 pyramids: ...".
void refuse_solids(const CellList& cells, const std::filesystem::path& path) {
  std::array<std::int64_t, 256> counts{};
  for (const std::uint8_t type : cells.types) {
    counts.at(type) += is_solid(type) ? 1 : 0;
  }
  const auto count_of = [&counts](std::initializer_list<std::uint8_t> types) {
    std::int64_t count = 0;
    for (const std::uint8_t type : types) {
      count += std::exchange(counts[type], 0);
    }
    return count;
  };
  std::string solids;
  const auto add = [&solids](std::int64_t count, std::string_view one, std::string_view several) {
    if (count > 0) {
      add_to_list(solids, counted(count, one, several));
    }
  };
  using namespace cell_type;
  add(count_of({tetrahedron, quadratic_tetrahedron, lagrange_tetrahedron}), "tetrahedron", "tetrahedra");
  add(count_of({hexahedron, quadratic_hexahedron, triquadratic_hexahedron, lagrange_hexahedron}), "hexahedron",
      "hexahedra");
  add(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}),
      solids.empty() ? "solid cell" : "other solid cell", solids.empty() ? "solid cells" : "other solid cells");
  if (!solids.empty()) {
    throw ReadError(path, "holds " + solids +
                              ": a mesh of solids is not smoothed, only plane meshes of triangles and quadrilaterals "
                              "are");
  }
}

void lay_into_plane(PlanarMesh& mesh, const PlaneFit& fit, const MeshDocument& document,
                    const std::filesystem::path& path, Workers& workers) {
  if (!fit.is_planar()) {
    refuse_solids(document.cells, path);
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
PlanarMesh sorted_mesh(const MeshDocument& document, const std::filesystem::path& path, Quads quads, Workers& workers) {
  check_document_size(document.point_count(), document.cells.size(), path);
  PlanarMesh mesh;
  static_cast<ElementCells&>(mesh) = element_cells(document, workers, quads);
  if (mesh.elements.empty()) {
    refuse_solids(document.cells, path);
  }
  require_elements(static_cast<std::int64_t>(mesh.elements.size()), static_cast<std::int64_t>(document.cells.size()),
                   path, {mesh.high_order_triangles, mesh.high_order_quads, mesh.held_quads});
  if (mesh.elements.empty()) {
    mesh.notes.emplace_back("the file holds no cells: nothing to smooth");
  }
  return mesh;
}

}  // namespace

void require_elements(std::int64_t elements, std::int64_t cells, const std::filesystem::path& path,
                      const UnsmoothedCells& unsmoothed) {
  if (elements > 0 || cells == 0) {
    return;
  }
  const std::string holds = "holds " + counted(cells, "cell", "cells") + " but no ";
  const auto has = [](std::int64_t count) { return counted(count, "has", "have"); };
  if (unsmoothed.held_quads > 0) {
    throw ReadError(path,
                    holds + "triangle; " +
                        counted(unsmoothed.held_quads, "is a quadrilateral that is", "are quadrilaterals that are") +
                        " held; --quads smooth smooths them");
  }
  if (unsmoothed.crossed_quads > 0) {
    throw ReadError(path, holds + "element that could be smoothed; " +
                              counted(unsmoothed.crossed_quads, "is a quadrilateral", "are quadrilaterals") +
                              " whose corners are not listed in turn, around the element: list them so");
  }
  if (unsmoothed.high_order_triangles > 0) {
    throw ReadError(path, holds + "triangle of three or six nodes; " + has(unsmoothed.high_order_triangles) +
                              " seven, ten or more (cubic triangles and the like), which are not smoothed: save the "
                              "mesh with elements of order 1 or 2");
  }
  if (unsmoothed.high_order_quads > 0) {
    throw ReadError(path, holds + "quadrilateral of four, eight or nine nodes; " + has(unsmoothed.high_order_quads) +
                              " six, or more than nine (cubic ones and the like), which are not smoothed: save the "
                              "mesh with elements of order 1 or 2");
  }
  throw ReadError(path, holds + "triangle; only meshes of triangles and quadrilaterals can be smoothed");
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

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers, Quads quads) {
  PlanarMesh mesh = sorted_mesh(document, path, quads, workers);
  lay_into_plane(mesh, fit_plane(document.points, mesh.in_cell, document.cells, storage_of(document), workers),
                 document, path, workers);
  return mesh;
}

PlanarMesh projected_mesh(const MeshDocument& document, const std::filesystem::path& path, Workers& workers,
                          Quads quads) {
  PlanarMesh mesh = sorted_mesh(document, path, quads, workers);
  lay_into_plane(mesh, {}, document, path, workers);
  return mesh;
}

PlanarMesh mesh_of_piece(const MeshDocument& document, const std::filesystem::path& path, Quads quads,
                         Workers& workers) {
  check_document_size(document.point_count(), document.cells.size(), path);
  PlanarMesh mesh;
  static_cast<ElementCells&>(mesh) = element_cells(document, workers, quads);
  mesh.notes.clear();
  lay_into_plane(mesh, {}, document, path, workers);
  return mesh;
}

PlanarMesh planar_mesh(const MeshDocument& document, const std::filesystem::path& path, Quads quads) {
  Workers one(1);
  return planar_mesh(document, path, one, quads);
}

bool settle_plane(PlanarMesh& mesh, const MeshDocument& document, std::span<const std::uint8_t> fixed,
                  const std::filesystem::path& path, Workers& workers) {
  const auto fit = plane_of_fixed(mesh.plane, document.points, mesh.in_cell, fixed, storage_of(document));
  if (fit) {
    lay_into_plane(mesh, *fit, document, path, workers);
  }
  return fit.has_value();
}

std::int64_t settle_middles(PlanarMesh& mesh, std::span<const double> points, std::vector<std::uint8_t>& named) {
  SettledMiddles settled = settle_middles(mesh.elements, mesh.quadratics, named, mesh.in_other_cell);
  mesh.middles = std::move(settled.following);
  find_shares(mesh.middles, [points](std::int32_t vertex) {
    const double* const p = points.data() + 3 * static_cast<std::size_t>(vertex);
    return std::array<double, 3>{p[0], p[1], p[2]};
  });
  return settled.shared;
}

}  // namespace trismooth
