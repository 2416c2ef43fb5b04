#include <algorithm>
#include <array>
#include <iterator>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/off/off_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr std::array face_types{cell_type::triangle, cell_type::quad, cell_type::polygon};

bool is_face(std::uint8_t type) {
  return std::ranges::find(face_types, type) != face_types.end();
}

void write_off(const std::filesystem::path& path, const MeshDocument& document) {
  const CellList& cells = document.cells;
  TextMeshWriter writer(path);
  writer.word("OFF").end_line();
  writer.integer(static_cast<std::int64_t>(document.point_count()))
      .integer(std::ranges::count_if(cells.types, &is_face))
      .integer(0)
      .end_line();
  for (std::size_t i = 0; i < document.points.size(); i += 3) {
    writer.number(document.points[i]).number(document.points[i + 1]).number(document.points[i + 2]).end_line();
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (is_face(cells.types[cell])) {
      writer.integer(static_cast<std::int64_t>(cells[cell].size()));
      for (const std::int32_t vertex : cells[cell]) {
        writer.integer(vertex);
      }
      writer.end_line();
    }
  }
  writer.close();
}

std::vector<std::string> lost_in_off(const MeshDocument& document) {
  std::vector<std::string> sentences = describe_lost_cells("OFF", "faces", face_types, document.cells);
  std::ranges::move(describe_lost_arrays("OFF", document), std::back_inserter(sentences));
  return sentences;
}

}  // namespace

const Codec off_codec{&read_off, &write_off, &lost_in_off};

}  // namespace trismooth
