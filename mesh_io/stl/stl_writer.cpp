// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/stl/point_welder.h"
#include "trismooth/mesh_io/stl/stl.h"
#include "trismooth/mesh_io/text/text_block.h"

namespace trismooth {

namespace {

using Vector = std::array<double, 3>;

constexpr std::array<std::uint8_t, 1> stl_cell_types{cell_type::triangle};

Vector point_at(const MeshDocument& document, std::int32_t vertex) {
  const std::size_t first = 3 * static_cast<std::size_t>(vertex);
  return {document.points[first], document.points[first + 1], document.points[first + 2]};
}

/// The vector in the same direction whose largest component is 1 or -1; 0 where there is none.
Vector scaled(const Vector& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  return largest > 0 ? Vector{v[0] / largest, v[1] / largest, v[2] / largest} : Vector{};
}

Vector difference(const Vector& a, const Vector& b) {
  // Halves, so that points at opposite ends of the range have a finite difference.
  return {a[0] / 2 - b[0] / 2, a[1] / 2 - b[1] / 2, a[2] / 2 - b[2] / 2};
}

Vector unit_normal(const Vector& a, const Vector& b, const Vector& c) {
  const Vector u = scaled(difference(b, a));
  const Vector v = scaled(difference(c, a));
  const Vector n = scaled({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  // Adding 0 turns -0 into 0.
  return length > 0 ? Vector{n[0] / length + 0.0, n[1] / length + 0.0, n[2] / length + 0.0} : Vector{};
}

void append_vector(TextBlock& text, const Vector& vector) {
  for (const double component : vector) {
    text.text(' ').number(component);
  }
  text.text('\n');
}

void append_facet(TextBlock& text, const std::array<Vector, 3>& corners) {
  text.text("  facet normal");
  append_vector(text, unit_normal(corners[0], corners[1], corners[2]));
  text.text("    outer loop\n");
  for (const Vector& corner : corners) {
    text.text("      vertex");
    append_vector(text, corner);
  }
  text.text("    endloop\n  endfacet\n");
}

void describe_arrays(std::vector<std::string>& lost, std::string_view kind, std::span<const DataArray> arrays) {
  for (const DataArray& array : arrays) {
    lost.push_back("STL holds no arrays: " + std::string(kind) + " array '" + array.name + "' is not written");
  }
}

/// What becomes of the points, seen as a reader will weld them.
void describe_points(std::vector<std::string>& lost, const MeshDocument& document) {
  PointWelder welder;
  std::vector<bool> used(document.point_count());
  bool renumbered = false;
  for (std::size_t c = 0; c < document.cells.size(); ++c) {
    if (document.cells.types[c] != cell_type::triangle) {
      continue;
    }
    for (const std::int32_t vertex : document.cells[c]) {
      used[static_cast<std::size_t>(vertex)] = true;
      renumbered = welder.weld(point_at(document, vertex)) != vertex || renumbered;
    }
  }
  const auto used_count = static_cast<std::size_t>(std::ranges::count(used, true));
  if (used_count < document.point_count()) {
    lost.push_back("STL holds corners of triangles only: " + std::to_string(document.point_count() - used_count) +
                   " points that no triangle uses are not written");
  }
  if (welder.size() < used_count) {
    lost.push_back("STL holds no vertices, only coordinates: points at the same place become one, which leaves " +
                   std::to_string(welder.size()) + " of " + std::to_string(used_count));
  }
  if (renumbered) {
    lost.emplace_back("STL holds no vertices, only coordinates: the numbering of the points is not kept");
  }
}

}  // namespace

void write_stl(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  constexpr std::size_t facet_bytes = 320;
  BufferedWriter writer(path);
  OrderedBlocks blocks([&writer](std::string_view block) { writer.write(block); }, workers);
  blocks.write("solid trismooth\n");
  blocks.write_rows(document.cells.size(), facet_bytes, [&](std::size_t begin, std::size_t end, MemoryBlock& bytes) {
    TextBlock text(bytes);
    for (std::size_t c = begin; c < end; ++c) {
      if (document.cells.types[c] == cell_type::triangle) {
        const auto vertices = document.cells[c];
        append_facet(
            text, {point_at(document, vertices[0]), point_at(document, vertices[1]), point_at(document, vertices[2])});
      }
    }
  });
  blocks.write("endsolid trismooth\n");
  writer.close();
}

std::vector<std::string> what_stl_loses(const MeshDocument& document) {
  std::vector<std::string> lost;
  if (const std::string others = describe_other_cells(document.cells, stl_cell_types); !others.empty()) {
    lost.push_back("STL holds triangles only: not written are " + others);
  }
  describe_points(lost, document);
  describe_arrays(lost, "point", document.point_arrays);
  describe_arrays(lost, "cell", document.cell_arrays);
  describe_arrays(lost, "field", document.field_arrays);
  return lost;
}

}  // namespace trismooth
