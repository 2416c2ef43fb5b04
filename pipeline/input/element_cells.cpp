// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/element_cells.h"

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <tuple>

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

constexpr std::uint8_t pixel = 8;  // a quadrilateral whose corners go by rows

/// 4, 8 or 9 for a quadrilateral with so many nodes, else 0.
std::size_t nodes_of_quad(std::uint8_t type, std::span<const std::int32_t> vertices) {
  const std::uint8_t fixed_order = type_of_fixed_order(type, vertices.size());
  const bool is_straight = type == pixel || ordinary_type(type, vertices.size()) == cell_type::quad;
  const std::size_t nodes = is_straight                                  ? 4
                            : fixed_order == cell_type::quadratic_quad   ? 8
                            : fixed_order == cell_type::biquadratic_quad ? 9
                                                                         : 0;
  return vertices.size() == nodes ? nodes : 0;
}

bool is_high_order_quad(std::uint8_t type, std::span<const std::int32_t> vertices) {
  constexpr std::uint8_t quadratic_linear_quad = 30;
  return type == quadratic_linear_quad || (type == cell_type::lagrange_quad && vertices.size() > 9);
}

bool repeats_a_vertex(std::span<const std::int32_t> corners) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (corners[i] == corners[j]) {
        return true;
      }
    }
  }
  return false;
}

/// Whether a cell is an element of that kind whose corners stand in the document as they are.
template <class Corners>
bool stands_as(std::uint8_t type, std::span<const std::int32_t> vertices) {
  constexpr std::uint8_t wanted = std::same_as<Corners, Triangle> ? cell_type::triangle : cell_type::quad;
  return ordinary_type(type, vertices.size()) == wanted && !repeats_a_vertex(vertices);
}

/// Takes the cells of a document that has elements of one kind alone, as they lie there; false, and nothing is taken,
/// where it has others.
template <class Corners>
bool take_all(const CellList& cells, ElementCells& mesh, Workers& workers) {
  constexpr std::int64_t corners = std::tuple_size_v<Corners>;
  if (cells.connectivity.size() != corners * cells.size()) {
    return false;
  }
  const std::int64_t count = std::ssize(cells.types);
  mesh.cells.resize(cells.size());
  std::atomic<bool> has_others{false};
  workers.for_blocks(count, cell_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t c = begin; c < end; ++c) {
      if (cells.offsets[c + 1] != corners * (c + 1) ||
          !stands_as<Corners>(cells.types[c], {cells.connectivity.data() + corners * c, corners})) {
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
  static_assert(sizeof(Corners) == corners * sizeof(std::int32_t) && alignof(Corners) == alignof(std::int32_t));
  mesh.elements = std::span(reinterpret_cast<const Corners*>(cells.connectivity.data()), cells.size());
  return true;
}

/// Counts a cell that is no element, and holds its vertices.
void hold_cell(const MeshDocument& document, std::size_t cell, ElementCells& mesh) {
  const std::uint8_t type = document.cells.types[cell];
  const auto vertices = document.cells[cell];
  mesh.repeating.count(type, vertices, cell);
  mesh.high_order_triangles += is_high_order(type, vertices) ? 1 : 0;
  mesh.high_order_quads += is_high_order_quad(type, vertices) ? 1 : 0;
  mesh.held_quads += quad_of_cell(type, vertices) ? 1 : 0;
  ++mesh.other_cells;
  mesh.lines += cell_type::dimension(type) == 1 ? 1 : 0;
  for (const std::int32_t v : vertices) {
    mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
  }
}

void note_high_order(std::int64_t count, const std::string& kind, const std::string& nodes, ElementCells& mesh) {
  if (count > 0) {
    mesh.notes.push_back(counted(count, "of these cells is a " + kind, "of these cells are " + kind + "s") + " of " +
                         nodes + ", which are not smoothed: save the mesh with elements of order 1 or 2");
  }
}

void sort_cells(const MeshDocument& document, ElementCells& mesh, Quads quads, Workers& workers) {
  mesh.in_other_cell.assign(document.point_count(), 0);
  mesh.in_cell.assign(document.point_count(), 0);
  const std::vector<std::int32_t>& connectivity = document.cells.connectivity;
  workers.for_blocks(std::ssize(connectivity), 3 * cell_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      set_bits_relaxed(mesh.in_cell[static_cast<std::size_t>(connectivity[i])], 1);
    }
  });
  if (take_all<Triangle>(document.cells, mesh, workers) ||
      (quads == Quads::smooth && take_all<MixedElement>(document.cells, mesh, workers))) {
    return;
  }
  std::int64_t collapsed = 0;
  mesh.cells.reserve(document.cells.size());
  const auto add = [&mesh](const auto& corners, std::size_t cell) {
    mesh.listed.append(corners);
    mesh.cells.push_back(static_cast<std::int32_t>(cell));
  };
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    const std::uint8_t type = document.cells.types[c];
    const auto vertices = document.cells[c];
    if (type == cell_type::triangle_strip) {
      const std::size_t before = mesh.cells.size();
      for_each_strip_triangle(vertices, [&](const Triangle& triangle) { add(triangle, c); });
      if (mesh.cells.size() > before) {
        continue;
      }
    }
    if (const auto triangle = triangle_of_cell(type, vertices)) {
      if (triangle->middles) {
        const auto [ab, bc, ca] = *triangle->middles;
        mesh.quadratics.push_back({static_cast<std::int32_t>(mesh.cells.size()), {ab, bc, ca, no_corner, no_corner}});
      }
      collapsed += triangle->is_quad ? 1 : 0;
      add(triangle->corners, c);
    } else if (const auto quad = quads == Quads::smooth ? quad_of_cell(type, vertices) : std::nullopt) {
      if (quad->middles) {
        mesh.quadratics.push_back({static_cast<std::int32_t>(mesh.cells.size()), *quad->middles});
      }
      add(quad->corners, c);
    } else {
      hold_cell(document, c, mesh);
    }
  }
  mesh.elements = mesh.listed.list();
  mesh.notes = notes_of_other_cells(mesh.other_cells, mesh.lines, mesh.repeating,
                                    mesh.elements.are_triangles() ? "triangle" : "triangle and quadrilateral");
  if (collapsed > 0) {
    mesh.notes.push_back(note_of_collapsed_quads(collapsed));
  }
  note_high_order(mesh.high_order_triangles, "triangle", "seven, ten or more nodes (cubic triangles and the like)",
                  mesh);
  note_high_order(mesh.high_order_quads, "quadrilateral", "six nodes, or of more than nine (cubic ones and the like)",
                  mesh);
}

/// Named boundaries hold their vertices as line cells do.
void hold_named_sides(const MeshDocument& document, ElementCells& mesh) {
  mesh.sides = find_named_sides(document, mesh);
  const NamedSides& sides = mesh.sides;
  for (const std::int32_t v : sides.lines) {
    mesh.in_other_cell[static_cast<std::size_t>(v)] = 1;
  }
  if (sides.count() > 0) {
    mesh.notes.push_back("named boundaries on sides of elements (" + sides.names + "; " +
                         counted(sides.count(), "side", "sides") +
                         "): their vertices are held, or slide along them with --slide");
  }
}

}  // namespace

std::int64_t ElementCells::count_quadrilaterals() const {
  return elements.count_quadrilaterals();
}

std::int64_t ElementCells::count_quadratic_quads() const {
  return std::ranges::count_if(quadratics, [this](const QuadraticElement& quadratic) {
    return elements[static_cast<std::size_t>(quadratic.element)].size() == 4;
  });
}

ElementCells element_cells(const MeshDocument& document, Workers& workers, Quads quads) {
  ElementCells mesh;
  sort_cells(document, mesh, quads, workers);
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

std::optional<CellQuad> quad_of_cell(std::uint8_t type, std::span<const std::int32_t> vertices) {
  const std::size_t nodes = nodes_of_quad(type, vertices);
  if (nodes == 0 || repeats_a_vertex(vertices)) {
    return std::nullopt;
  }
  CellQuad quad{{vertices[0], vertices[1], vertices[2], vertices[3]}, std::nullopt};
  if (type == pixel) {
    std::swap(quad.corners[2], quad.corners[3]);
  } else if (nodes > 4) {
    quad.middles = {vertices[4], vertices[5], vertices[6], vertices[7], nodes == 9 ? vertices[8] : no_corner};
  }
  return quad;
}

bool is_flat_triangle(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return (is_triangle(type, vertices) || is_quadratic(type, vertices)) && repeats_a_vertex(vertices);
}

bool is_repeating_quad(std::uint8_t type, std::span<const std::int32_t> vertices) {
  return nodes_of_quad(type, vertices) > 0 && repeats_a_vertex(vertices) && !triangle_of_quad(type, vertices);
}

std::int64_t count_triangles(std::uint8_t type, std::span<const std::int32_t> vertices) {
  if (type == cell_type::triangle_strip) {
    std::int64_t count = 0;
    for_each_strip_triangle(vertices, [&count](const Triangle&) { ++count; });
    return count;
  }
  return triangle_of_cell(type, vertices) ? 1 : 0;
}

void RepeatingCells::count(std::uint8_t type, std::span<const std::int32_t> vertices, std::size_t cell) {
  if (is_flat_triangle(type, vertices) && triangles++ == 0) {
    first_triangle = cell;
  }
  if (is_repeating_quad(type, vertices) && quads++ == 0) {
    first_quad = cell;
  }
}

std::string note_of_collapsed_quads(std::int64_t quads) {
  return counted(quads, "quadrilateral repeats a corner: it is smoothed as the triangle that it is",
                 "quadrilaterals repeat a corner: they are smoothed as the triangles that they are");
}

std::vector<std::string> notes_of_other_cells(std::int64_t other_cells, std::int64_t lines,
                                              const RepeatingCells& repeating, std::string_view kinds) {
  std::vector<std::string> notes;
  const auto named = [](std::int64_t count, const char* kind, const char* repeats, std::optional<std::size_t> first) {
    return counted(count, kind, std::string(kind) + "s") + " repeating a " + repeats + " (the first is cell " +
           std::to_string(first.value_or(0)) + "): kept as they are, their vertices held fixed";
  };
  if (repeating.triangles > 0) {
    notes.push_back(named(repeating.triangles, "triangle", "vertex", repeating.first_triangle));
  }
  if (const std::int64_t others = other_cells - repeating.triangles - repeating.quads; others > 0) {
    notes.push_back(others == lines ? counted(others, "line", "lines") +
                                          ": not smoothed, their vertices held fixed but where they slide (--slide)"
                                    : counted(others, "cell", "cells") + " of other types than " + std::string(kinds) +
                                          ": not smoothed, their vertices held fixed");
  }
  if (repeating.quads > 0) {
    notes.push_back(named(repeating.quads, "quadrilateral", "node", repeating.first_quad) +
                    "; listed as triangles of three or six nodes, or with nodes that differ, they are smoothed");
  }
  return notes;
}

}  // namespace trismooth
