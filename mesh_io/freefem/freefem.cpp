// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/point_labels.h"
#include "trismooth/mesh_io/freefem/freefem_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr std::string_view freefem_title = "FreeFem";
constexpr std::array freefem_types{cell_type::triangle, cell_type::line};

void write_freefem(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  require_flat_points(path, freefem_title, document);
  const CellList& cells = document.cells;
  const CellGroups groups = find_cell_groups(document);
  const DataArray* const labels = find_point_labels(document);
  TextMeshWriter writer(path, workers);
  writer.write_line([&](TextLines& line) {
    line.number(document.point_count());
    for (const std::uint8_t type : freefem_types) {
      line.number(std::ranges::count(cells.types, type));
    }
  });
  writer.write_lines(document.point_count(), [&](TextLines& lines, std::size_t vertex) {
    lines.number(document.points[3 * vertex]).number(document.points[3 * vertex + 1]);
    lines.number(labels == nullptr ? 0 : point_label(*labels, vertex)).end_line();
  });
  for (const std::uint8_t type : freefem_types) {
    writer.write_lines(cells.size(), [&](TextLines& lines, std::size_t cell) {
      if (cells.types[cell] != type) {
        return;
      }
      for (const std::int32_t vertex : cells[cell]) {
        lines.number(std::int64_t{vertex} + 1);
      }
      const std::int32_t group = groups.of_cell.empty() ? -1 : groups.of_cell[cell];
      lines.number(group < 0 ? 0 : groups.groups[static_cast<std::size_t>(group)].number).end_line();
    });
  }
  writer.close();
}

std::vector<std::string> lost_in_freefem(const MeshDocument& document) {
  std::vector<std::string> sentences =
      describe_lost_cells(freefem_title, "triangles and edges", freefem_types, document.cells);
  const auto add = [&sentences](std::vector<std::string> more) {
    std::ranges::move(more, std::back_inserter(sentences));
  };
  add(describe_lost_z(freefem_title, document));
  add(describe_unlabelled_arrays(freefem_title, document, find_point_labels(document), find_cell_groups(document)));
  add(describe_lost_sets(freefem_title, document));
  add(describe_new_order(freefem_title, freefem_types, document.cells));
  return sentences;
}

}  // namespace

const Codec freefem_codec{{FileFormat::freefem,
                           "freefem",
                           "FreeFem",
                           {".msh"},
                           {.names = true, .quads = false, .collapsed_quads = false, .curved_cells = false},
                           1},
                          &read_freefem,
                          &write_freefem,
                          &lost_in_freefem,
                          &begins_as_freefem};

}  // namespace trismooth
