// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/off/off_keyword.h"
#include "trismooth/mesh_io/off/off_reader.h"
#include "trismooth/mesh_io/text/text_head.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::array face_types{cell_type::triangle, cell_type::quad, cell_type::polygon};

bool is_face(std::uint8_t type) {
  return std::ranges::find(face_types, type) != face_types.end();
}

void write_off(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  TextMeshWriter writer(path, workers);
  writer.write_line([](TextLines& line) { line.word("OFF"); });
  writer.write_line([&](TextLines& line) {
    line.number(document.point_count()).number(std::ranges::count_if(cells.types, &is_face)).number(0);
  });
  writer.write_lines(document.point_count(), [&points = document.points](TextLines& lines, std::size_t i) {
    lines.number(points[3 * i]).number(points[3 * i + 1]).number(points[3 * i + 2]).end_line();
  });
  writer.write_lines(cells.size(), [&cells](TextLines& lines, std::size_t cell) {
    if (is_face(cells.types[cell])) {
      lines.number(cells[cell].size());
      for (const std::int32_t vertex : cells[cell]) {
        lines.number(vertex);
      }
      lines.end_line();
    }
  });
  writer.close();
}

std::vector<std::string> lost_in_off(const MeshDocument& document) {
  std::vector<std::string> sentences = describe_lost_cells("OFF", "faces", face_types, document.cells);
  std::ranges::move(describe_lost_arrays("OFF", document), std::back_inserter(sentences));
  return sentences;
}

/// A keyword with a count behind it, or the word BINARY. Files without the keyword show nothing.
bool is_off(std::string_view bytes) {
  TextScanner scanner(text_head(bytes), {}, TextScanner::Comments::hash);
  const std::string_view token = scanner.peek_token();
  const auto keyword = parse_off_keyword(token);
  if (!keyword) {
    return false;
  }
  scanner.seek(static_cast<std::size_t>(token.data() - scanner.text().data()) + keyword->text.size());
  const std::string_view next = scanner.peek_token();
  return next == "BINARY" || (!next.empty() && next.find_first_not_of("0123456789") == next.npos);
}

}  // namespace

const Codec off_codec{
    {FileFormat::off, "off", "OFF", {".off"}, {.curved_cells = false}}, &read_off, &write_off, &lost_in_off, &is_off};

}  // namespace trismooth
