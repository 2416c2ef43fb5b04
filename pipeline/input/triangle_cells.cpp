// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/triangle_cells.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "trismooth/base/machine/relaxed_atomics.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/document/cells/collapsed_quads.h"
#include "trismooth/mesh_io/document/cells/lagrange_cells.h"
#include "trismooth/mesh_io/document/cells/strip_triangles.h"

namespace trismooth {

namespace {

constexpr std::int64_t cell_grain = 8192;

bool is_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 3 && ordinary_type(type, vertices.size()) == cell_type::triangle;
}

bool is_quadratic(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return vertices.size() == 6 && type_of_fixed_order(type, vertices.size()) == cell_type::quadratic_triangle;
}

bool is_high_order(std::uint8_t type, std::span<const std::int32_t> vertices) {
  constexpr std::uint8_t biquadratic_triangle = 34;
  return type == biquadratic_triangle || (type == cell_type::lagrange_triangle && vertices.size() > 6);
}

bool repeats_a_vertex(std::span<const std::int32_t> triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

/// Adds the triangles of a strip; false where it has none.
bool add_strip(std::span<const std::int32_t> strip, std::size_t cell, TriangleCells& mesh) {
  for_each_strip_triangle(strip, [&](const Triangle& triangle) { mesh.triangles_of_cells.push_back(triangle); });
  const bool has_triangles = mesh.cells.size() < mesh.triangles_of_cells.size();
  mesh.cells.resize(mesh.triangles_of_cells.size(), static_cast<std::int32_t>(cell));
  return has_triangles;
}

/// Takes the cells of a document that has triangles alone, as they lie there; false, and nothing is taken, where it has
/// others.
bool take_triangles(const CellList& cells, TriangleCells& mesh, Workers& workers) {
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

void sort_cells(const MeshDocument& document, TriangleCells& mesh, Workers& workers) {
  std::size_t first_repeating = 0;
  std::int64_t quads = 0;
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
    if (const auto triangle = triangle_of_cell(document.cells.types[c], vertices)) {
      if (triangle->middles) {
        mesh.quadratics.push_back({static_cast<std::int32_t>(mesh.triangles_of_cells.size()), *triangle->middles});
      }
      quads += triangle->is_quad ? 1 : 0;
      mesh.triangles_of_cells.push_back(triangle->corners);
      mesh.cells.push_back(static_cast<std::int32_t>(c));
      continue;
    }
    if (is_flat_triangle(document.cells.types[c], vertices) && mesh.repeating_triangles++ == 0) {
      first_repeating = c;
    }
    mesh.high_order_triangles += is_high_order(document.cells.types[c], vertices) ? 1 : 0;
    ++mesh.other_cells;
    for (const std::int32_t v : vertices) {
      mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
    }
  }
  mesh.triangles = mesh.triangles_of_cells;
  mesh.notes = notes_of_other_cells(mesh.other_cells, mesh.repeating_triangles, first_repeating);
  if (quads > 0) {
    mesh.notes.push_back(counted(quads, "quadrilateral repeats a corner: it is smoothed as the triangle that it is",
                                 "quadrilaterals repeat a corner: they are smoothed as the triangles that they are"));
  }
  if (mesh.high_order_triangles > 0) {
    mesh.notes.push_back(
        counted(mesh.high_order_triangles, "of these cells is a triangle", "of these cells are triangles") +
        " of seven, ten or more nodes (cubic triangles and the like), which are not smoothed: save the "
        "mesh with elements of order 1 or 2");
  }
}

/// Named boundaries hold their vertices as line cells do.
void hold_named_sides(const MeshDocument& document, TriangleCells& mesh) {
  mesh.sides = find_named_sides(document, mesh);
  const NamedSides& sides = mesh.sides;
  for (const std::int32_t v : sides.lines) {
    mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
  }
  if (sides.count() > 0) {
    mesh.notes.push_back("named boundaries on sides of triangles (" + sides.names + "; " +
                         counted(sides.count(), "side", "sides") +
                         "): their vertices are held, or slide along them with --slide");
  }
}

}  // namespace

TriangleCells triangle_cells(const MeshDocument& document, Workers& workers) {
  TriangleCells mesh;
  sort_cells(document, mesh, workers);
  hold_named_sides(document, mesh);
  return mesh;
}

std::optional<CellTriangle> triangle_of_cell(std::uint8_t type, std::span<const std::int32_t> vertices) {
  const bool quadratic = is_quadratic(type, vertices);
  if (!quadratic && !is_triangle(type, vertices)) {
    const auto quad = triangle_of_quad(type, vertices);
    return quad ? std::optional(CellTriangle{quad->corners, quad->middles, true}) : std::nullopt;
  }
  if (repeats_a_vertex(vertices)) {
    return std::nullopt;
  }
  CellTriangle triangle{{vertices[0], vertices[1], vertices[2]}, std::nullopt};
  if (quadratic) {
    triangle.middles = {vertices[3], vertices[4], vertices[5]};
  }
  return triangle;
}

bool is_flat_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return (is_triangle(type, vertices) || is_quadratic(type, vertices)) && repeats_a_vertex(vertices);
}

std::int64_t count_triangles(std::uint8_t type, std::span<const std::int32_t> vertices) {
  if (type == cell_type::triangle_strip) {
    std::int64_t count = 0;
    for_each_strip_triangle(vertices, [&count](const Triangle&) { ++count; });
    return count;
  }
  return triangle_of_cell(type, vertices) ? 1 : 0;
}

std::vector<std::string> notes_of_other_cells(std::int64_t other_cells, std::int64_t repeating_triangles,
                                              std::optional<std::size_t> first_repeating) {
  std::vector<std::string> notes;
  if (repeating_triangles > 0) {
    notes.push_back(
        counted(repeating_triangles, "triangle", "triangles") + " repeating a vertex" +
        (first_repeating ? " (the first is cell " + std::to_string(*first_repeating) + ")" : std::string()) +
        ": kept as they are, their vertices held fixed");
  }
  if (other_cells > repeating_triangles) {
    notes.push_back(counted(other_cells - repeating_triangles, "cell", "cells") +
                    " of other types than triangle: not smoothed, their vertices held fixed");
  }
  return notes;
}

}  // namespace trismooth
