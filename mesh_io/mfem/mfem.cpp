// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/mfem/mfem_geometry.h"
#include "trismooth/mesh_io/mfem/mfem_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::array written_types{cell_type::line, cell_type::triangle, cell_type::quad};

bool is_mfem(std::string_view bytes) {
  bytes.remove_prefix(begin_of_text(bytes));
  return bytes.starts_with("MFEM ");
}

/// The elements of one dimension, and what MFEM is told of them.
class MfemElements {
 public:
  MfemElements(const MeshDocument& document, const CellGroups& groups, int dimension)
      : document_(document), groups_(groups) {
    for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
      const std::uint8_t type = document.cells.types[cell];
      if (cell_type::dimension(type) == dimension && std::ranges::find(written_types, type) != written_types.end()) {
        cells_.push_back(cell);
      }
    }
    number(dimension);
  }

  bool has_names() const {
    return std::ranges::any_of(names_, [](const auto& name) { return !name.second.empty(); });
  }

  void write(TextMeshWriter& writer, std::string_view section) const {
    writer.write_line([](TextLines& /*line*/) {});
    writer.write_line([section](TextLines& line) { line.word(section); });
    writer.write_line([this](TextLines& line) { line.number(cells_.size()); });
    writer.write_lines(cells_.size(), [this](TextLines& lines, std::size_t i) {
      const std::size_t cell = cells_[i];
      const auto* const geometry = std::ranges::find(mfem_geometries, document_.cells.types[cell], &MfemGeometry::cell);
      lines.number(attribute_of(cell)).number(geometry - mfem_geometries.begin());
      for (const std::int32_t vertex : document_.cells[cell]) {
        lines.number(vertex);
      }
      lines.end_line();
    });
  }

  void write_names(TextMeshWriter& writer, std::string_view section) const {
    writer.write_line([](TextLines& /*line*/) {});
    writer.write_line([section](TextLines& line) { line.word(section); });
    const auto count = std::ranges::count_if(names_, [](const auto& name) { return !name.second.empty(); });
    writer.write_line([count](TextLines& line) { line.number(count); });
    for (const auto& named : names_) {
      if (!named.second.empty()) {
        writer.write_line([&named](TextLines& line) {
          line.word(quoted_name(named.second)).number(named.first == 0 ? 0 : 1);
          if (named.first != 0) {
            line.number(named.first);
          }
        });
      }
    }
  }

 private:
  /// Attributes are positive: where a group's number is not, groups are counted. Cells without one have the next.
  void number(int dimension) {
    bool positive = true;
    std::int64_t highest = 0;
    for (const CellGroup& group : groups_.groups) {
      if (group.dimension == dimension) {
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() - 1;
        positive = positive && group.number > 0 && group.number <= most;
        highest = std::max(highest, group.number);
      }
    }
    attributes_.resize(groups_.groups.size());
    std::int64_t counted = 0;
    for (std::size_t i = 0; i < groups_.groups.size(); ++i) {
      const CellGroup& group = groups_.groups[i];
      if (group.dimension == dimension) {
        attributes_[i] = positive ? group.number : ++counted;
        names_.emplace_back(group.is_empty ? 0 : attributes_[i], group.name);
      }
    }
    none_ = 1 + (positive ? highest : counted);
  }

  std::int64_t attribute_of(std::size_t cell) const {
    const std::int32_t group = groups_.of_cell.empty() ? -1 : groups_.of_cell[cell];
    return group < 0 ? none_ : attributes_[static_cast<std::size_t>(group)];
  }

  /// No name can hold a quotation mark or the end of a line.
  static std::string quoted_name(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c == '"' || c == '\n' || c == '\r'; }, '_');
    return '"' + name + '"';
  }

  const MeshDocument& document_;
  const CellGroups& groups_;
  std::vector<std::size_t> cells_;
  std::vector<std::int64_t> attributes_;                     ///< of each group
  std::vector<std::pair<std::int64_t, std::string>> names_;  ///< attribute, or 0, and name, perhaps empty
  std::int64_t none_ = 1;                                    ///< of cells without a group
};

void write_mfem(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellGroups groups = find_cell_groups(document);
  const MfemElements elements(document, groups, 2);
  const MfemElements boundary(document, groups, 1);
  const bool has_names = elements.has_names() || boundary.has_names();
  bool flat = true;
  for (std::size_t i = 2; i < document.points.size(); i += 3) {
    flat = flat && document.points[i] == 0;
  }
  TextMeshWriter writer(path, workers);
  writer.write_line([has_names](TextLines& line) { line.word(has_names ? "MFEM mesh v1.3" : "MFEM mesh v1.0"); });
  writer.write_line([](TextLines& /*line*/) {});
  writer.write_line([](TextLines& line) { line.word("dimension"); });
  writer.write_line([](TextLines& line) { line.number(2); });
  elements.write(writer, "elements");
  if (has_names) {
    elements.write_names(writer, "attribute_sets");
  }
  boundary.write(writer, "boundary");
  if (has_names) {
    boundary.write_names(writer, "bdr_attribute_sets");
  }
  writer.write_line([](TextLines& /*line*/) {});
  writer.write_line([](TextLines& line) { line.word("vertices"); });
  writer.write_line([&document](TextLines& line) { line.number(document.point_count()); });
  writer.write_line([flat](TextLines& line) { line.number(flat ? 2 : 3); });
  writer.write_lines(document.point_count(), [&points = document.points, flat](TextLines& lines, std::size_t i) {
    lines.number(points[3 * i]).number(points[3 * i + 1]);
    if (!flat) {
      lines.number(points[3 * i + 2]);
    }
    lines.end_line();
  });
  if (has_names) {
    writer.write_line([](TextLines& /*line*/) {});
    writer.write_line([](TextLines& line) { line.word("mfem_mesh_end"); });
  }
  writer.close();
}

std::vector<std::string> lost_in_mfem(const MeshDocument& document) {
  std::vector<std::string> sentences =
      describe_lost_cells("MFEM", "lines, triangles and quadrilaterals", written_types, document.cells);
  const auto is_line = [](std::uint8_t type) { return type == cell_type::line; };
  const auto& types = document.cells.types;
  const auto last_face = std::find_if(types.rbegin(), types.rend(), [](std::uint8_t type) {
    return type == cell_type::triangle || type == cell_type::quad;
  });
  if (std::find_if(last_face, types.rend(), is_line) != types.rend()) {
    sentences.emplace_back("MFEM lists lines apart from faces: the cells are written in another order");
  }
  std::ranges::move(describe_lost_arrays("MFEM", document, {.cell = find_cell_groups(document).arrays}),
                    std::back_inserter(sentences));
  std::ranges::move(describe_lost_sets("MFEM", document), std::back_inserter(sentences));
  return sentences;
}

}  // namespace

const Codec mfem_codec{{FileFormat::mfem, "mfem", "MFEM", {".mesh"}, {.names = true, .curved_cells = false}},
                       &read_mfem,
                       &write_mfem,
                       &lost_in_mfem,
                       &is_mfem};

}  // namespace trismooth
