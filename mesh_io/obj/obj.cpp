// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/obj/obj_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr std::array statement_types{cell_type::vertex,    cell_type::poly_vertex, cell_type::line,
                                     cell_type::poly_line, cell_type::triangle,    cell_type::quad,
                                     cell_type::polygon};

/// The statement that holds a cell of the type; empty where none does.
std::string_view statement_of(std::uint8_t type) {
  switch (type) {
    case cell_type::vertex:
    case cell_type::poly_vertex:
      return "p";
    case cell_type::line:
    case cell_type::poly_line:
      return "l";
    case cell_type::triangle:
    case cell_type::quad:
    case cell_type::polygon:
      return "f";
    default:
      return {};
  }
}

void write_obj(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  TextMeshWriter writer(path, workers);
  if (document.points.empty()) {
    // An empty file is no OBJ, but comments alone are a mesh of nothing.
    writer.write_line([](TextLines& line) { line.word("# no vertices"); });
  }
  writer.write_lines(document.point_count(), [&points = document.points](TextLines& lines, std::size_t i) {
    lines.word("v").number(points[3 * i]).number(points[3 * i + 1]).number(points[3 * i + 2]).end_line();
  });
  writer.write_lines(cells.size(), [&cells](TextLines& lines, std::size_t cell) {
    const std::string_view statement = statement_of(cells.types[cell]);
    if (!statement.empty()) {
      lines.word(statement);
      for (const std::int32_t vertex : cells[cell]) {
        lines.number(std::int64_t{vertex} + 1);
      }
      lines.end_line();
    }
  });
  writer.close();
}

std::vector<std::string> lost_in_obj(const MeshDocument& document) {
  std::vector<std::string> sentences =
      describe_lost_cells("OBJ", "faces, lines and points", statement_types, document.cells);
  std::ranges::move(describe_lost_arrays("OBJ", document), std::back_inserter(sentences));
  return sentences;
}

}  // namespace

const Codec obj_codec{
    {FileFormat::obj, "obj", "OBJ", {".obj"}, {.curved_cells = false}, 1}, &read_obj, &write_obj, &lost_in_obj};

}  // namespace trismooth
