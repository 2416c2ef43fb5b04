// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/cell_copies.h"
#include "trismooth/pipeline/input/named_sides.h"
#include "trismooth/pipeline/quads.h"
#include "trismooth/quality/quadratic_quality.h"

namespace trismooth {

class Workers;

/// Cells that are no elements since they repeat a vertex.
struct RepeatingCells {
  std::int64_t triangles = 0;                 ///< is_flat_triangle()
  std::int64_t quads = 0;                     ///< is_repeating_quad()
  std::optional<std::size_t> first_triangle;  ///< the number of the first of these
  std::optional<std::size_t> first_quad;

  /// Counts a cell that is no element, if it is one of them. Cells come in order.
  void count(std::uint8_t type, std::span<const std::int32_t> vertices, std::size_t cell);
};

/// The elements that are smoothed among the cells of a document, triangles and quadrilaterals, and what the other cells
/// hold. The document outlives it, and its cells stay as they are.
struct ElementCells {
  ElementCells() = default;
  ElementCells(ElementCells&&) = default;
  ElementCells& operator=(ElementCells&&) = default;
  ElementCells(const ElementCells&) = delete;
  ElementCells& operator=(const ElementCells&) = delete;
  ~ElementCells() = default;

  /// In the document's order, each in the document's vertex order; listed as triangles where all are. They are the
  /// document's own connectivity where it has nothing but triangles, or nothing but quadrilaterals, else `listed`.
  ElementList elements;
  OwnElements listed;
  BulkVector<std::int32_t> cells;            ///< the document's cell of each element, ascending; a strip has several
  std::vector<CellCopy> copies;              ///< the cells that are these elements again: see take_out_copies()
  std::vector<QuadraticElement> quadratics;  ///< those of six, eight and nine nodes
  std::vector<std::uint8_t> in_other_cell;   ///< per vertex: 1 where a cell that is no element uses it, or the side of
                                             ///< an element that is a named boundary
  NamedSides sides;                          ///< these sides
  std::vector<std::uint8_t> in_cell;         ///< per vertex: 1 where any cell uses it; the others have no say at all
  std::int64_t other_cells = 0;              ///< cells that are no elements
  std::int64_t lines = 0;                    ///< those of them that are lines or curves
  RepeatingCells repeating;                  ///< those of them that repeat a vertex
  std::int64_t high_order_triangles = 0;     ///< those of them that are triangles of seven nodes, of ten, or of more
  std::int64_t high_order_quads = 0;         ///< and quadrilaterals of six nodes, or of more than nine
  std::int64_t held_quads = 0;               ///< and other quadrilaterals: Quads::hold
  std::int64_t crossed_quads = 0;            ///< and those that hold_crossed_quads() has found
  std::vector<std::string> notes;            ///< what the user should know, one sentence each

  /// Makes these the elements.
  template <class Corners>
  void list(std::vector<Corners> own) {
    listed = std::move(own);
    elements = listed.list();
  }
  /// How many of the elements are quadrilaterals. Complexity: linear.
  std::int64_t count_quadrilaterals() const;
  /// How many of the quadratic ones are quadrilaterals. Complexity: linear.
  std::int64_t count_quadratic_quads() const;
};

/// What the elements are called: "triangle" where all are.
inline std::string_view kind_of_elements(const ElementCells& mesh) {
  return mesh.elements.are_triangles() ? "triangle" : "element";
}

/// Finds them; of quadrilaterals what `quads` says. A triangle strip counts as its triangles (see strip_triangles.h),
/// and one with nodes in the middle of its sides as that of its corners, beside what `quadratics` says; see
/// triangle_of_cell() for the others. A note says how many quadrilaterals are triangles, and names elements of more
/// nodes. A triangle that repeats a vertex counts as another cell, and so does a quadrilateral that is no triangle for
/// that: it is kept, its vertices are held, and a note says so. Sides that are named boundaries (named_sides.h) hold
/// their vertices as line cells do. Where the mesh lies makes no difference. Complexity: linear.
ElementCells element_cells(const MeshDocument& document, Workers& workers, Quads quads = Quads::smooth);

/// Not of a temporary: the elements may be the document's own.
ElementCells element_cells(MeshDocument&& document, Workers& workers, Quads quads = Quads::smooth) = delete;

/// A cell as a triangle.
struct CellTriangle {
  Triangle corners;
  std::optional<std::array<std::int32_t, 3>> middles;  ///< of the sides 01, 12 and 20, where it has such
  bool is_quad = false;  ///< the cell is a quadrilateral that repeats a corner, as Ansys and Abaqus write triangles
};

/// The triangle that a cell is, corners in the cell's order, but for strips: triangles of three or six nodes, VTK's
/// Lagrange triangles (type 69) of order 1 and 2 among them, polygons of three, and quadrilaterals of four or eight
/// nodes of which two corners that follow each other are the same vertex, and no other ones. Constant time.
std::optional<CellTriangle> triangle_of_cell(std::uint8_t type, std::span<const std::int32_t> vertices);

/// A cell as a quadrilateral.
struct CellQuad {
  MixedElement corners;                                ///< in turn
  std::optional<std::array<std::int32_t, 5>> middles;  ///< where it has such: see QuadraticElement
};

/// The quadrilateral that a cell is whose nodes are all different: of four nodes, VTK's pixels and polygons of four
/// among them, or of eight or nine, Lagrange quadrilaterals of order 1 and 2 among all of these. Constant time.
std::optional<CellQuad> quad_of_cell(std::uint8_t type, std::span<const std::int32_t> vertices);

/// Whether the cell would be a triangle, did it not repeat a corner, so that it has no area.
bool is_flat_triangle(std::uint8_t type, std::span<const std::int32_t> vertices);

/// Whether the cell would be a quadrilateral, did it not repeat a node, and is no triangle. Constant time.
bool is_repeating_quad(std::uint8_t type, std::span<const std::int32_t> vertices);

/// The sentence about so many quadrilaterals, at least one, that are triangles: CellTriangle::is_quad.
std::string note_of_collapsed_quads(std::int64_t quads);

/// How many triangles of a mesh a cell of that type counts as, 0 where it is none.
std::int64_t count_triangles(std::uint8_t type, std::span<const std::int32_t> vertices);

/// What the user should know of cells that are no elements, `lines` and `repeating` ones among them, one sentence each.
/// `kinds`: what the elements are.
std::vector<std::string> notes_of_other_cells(std::int64_t other_cells, std::int64_t lines,
                                              const RepeatingCells& repeating, std::string_view kinds = "triangle");

}  // namespace trismooth
