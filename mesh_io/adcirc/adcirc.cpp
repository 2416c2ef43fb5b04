// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/adcirc/adcirc_boundary.h"
#include "trismooth/mesh_io/adcirc/adcirc_line_boundaries.h"
#include "trismooth/mesh_io/adcirc/adcirc_reader.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr std::array adcirc_types{cell_type::triangle, cell_type::quad};

/// The boundary that a set of points is written as. Those of weirs have heights, which sets have not.
std::optional<AdcircBoundary> written_boundary(const NamedSet& set) {
  const auto boundary = parse_adcirc_boundary(set.name);
  const bool needs_more =
      boundary && !boundary->is_open && (is_adcirc_weir(boundary->type) || has_adcirc_pairs(boundary->type));
  return needs_more ? std::nullopt : boundary;
}

/// The boundaries that the document has, as sets of points or else as lines.
AdcircLineBoundaries boundaries_to_write(const MeshDocument& document) {
  AdcircLineBoundaries found = find_adcirc_line_boundaries(document);
  for (const NamedSet& set : document.point_sets) {
    if (const auto boundary = written_boundary(set)) {
      found.boundaries.push_back({boundary->is_open, boundary->type, set.members});
    }
  }
  return found;
}

void write_boundaries(TextMeshWriter& writer, const AdcircLineBoundaries& all, bool open) {
  const std::string kind = open ? "open" : "land";
  std::vector<AdcircLineBoundaries::Boundary> boundaries;
  std::ranges::copy_if(all.boundaries, std::back_inserter(boundaries),
                       [open](const AdcircLineBoundaries::Boundary& boundary) { return boundary.is_open == open; });
  std::size_t nodes = 0;
  for (const AdcircLineBoundaries::Boundary& boundary : boundaries) {
    nodes += boundary.nodes.size();
  }
  writer.write_line(
      [&](TextLines& line) { line.number(boundaries.size()).word("= Number of " + kind + " boundaries"); });
  writer.write_line([&](TextLines& line) { line.number(nodes).word("= Total number of " + kind + " boundary nodes"); });
  std::size_t number = 0;
  for (const AdcircLineBoundaries::Boundary& boundary : boundaries) {
    ++number;
    writer.write_line([&](TextLines& line) {
      line.number(boundary.nodes.size());
      if (!open || boundary.type != 0) {
        line.number(boundary.type);
      }
      line.word("= Number of nodes for " + kind + " boundary").number(number);
    });
    writer.write_lines(boundary.nodes.size(), [&boundary](TextLines& lines, std::size_t i) {
      lines.number(std::int64_t{boundary.nodes[i]} + 1).end_line();
    });
  }
}

void write_adcirc(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  require_flat_points(path, "ADCIRC", document);
  const CellList& cells = document.cells;
  const std::vector<double> depths = find_place_values(document, PlaceValue::depth).values;
  // Rows of elements are numbered one after the other.
  std::vector<std::size_t> elements;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (std::ranges::find(adcirc_types, cells.types[cell]) != adcirc_types.end()) {
      elements.push_back(cell);
    }
  }
  TextMeshWriter writer(path, workers);
  writer.write_line([](TextLines& line) { line.word("grid"); });
  writer.write_line([&](TextLines& line) { line.number(elements.size()).number(document.point_count()); });
  writer.write_lines(document.point_count(), [&](TextLines& lines, std::size_t i) {
    lines.number(i + 1).number(document.points[3 * i]).number(document.points[3 * i + 1]).number(depths[i]).end_line();
  });
  writer.write_lines(elements.size(), [&](TextLines& lines, std::size_t i) {
    const auto corners = cells[elements[i]];
    lines.number(i + 1).number(corners.size());
    for (const std::int32_t vertex : corners) {
      lines.number(std::int64_t{vertex} + 1);
    }
    lines.end_line();
  });
  const AdcircLineBoundaries boundaries = boundaries_to_write(document);
  write_boundaries(writer, boundaries, true);
  write_boundaries(writer, boundaries, false);
  writer.close();
}

std::vector<std::string> lost_in_adcirc(const MeshDocument& document) {
  MeshDocument lost;
  lost.cell_sets = document.cell_sets;
  const std::string depths = find_place_values(document, PlaceValue::depth).array;
  std::ranges::copy_if(document.point_sets, std::back_inserter(lost.point_sets),
                       [](const NamedSet& set) { return !written_boundary(set); });
  const AdcircLineBoundaries boundaries = boundaries_to_write(document);
  CellList cells;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    if (boundaries.is_written.empty() || boundaries.is_written[cell] == 0) {
      cells.append(document.cells.types[cell], document.cells[cell]);
    }
  }
  std::vector<std::string> sentences =
      describe_lost_cells("ADCIRC", "triangles and quadrilaterals", adcirc_types, cells);
  std::ranges::copy(boundaries.losses, std::back_inserter(sentences));
  std::ranges::move(describe_lost_arrays("ADCIRC", document, {.point = depths}), std::back_inserter(sentences));
  if (!lost.point_sets.empty()) {
    sentences.push_back(
        "ADCIRC holds boundaries without heights by their names ('open boundary 1', 'land boundary "
        "1 (type 20)'), no other sets of points: " +
        list_text(lost.point_sets, shown_name<NamedSet>) + not_written(lost.point_sets.size()));
    lost.point_sets.clear();
  }
  std::ranges::move(describe_lost_sets("ADCIRC", lost), std::back_inserter(sentences));
  std::ranges::move(describe_lost_z("ADCIRC", document), std::back_inserter(sentences));
  std::ranges::move(describe_missing_place_values("ADCIRC", document, PlaceValue::depth),
                    std::back_inserter(sentences));
  if (boundaries.boundaries.empty()) {
    sentences.emplace_back(
        "ADCIRC runs with boundaries: the mesh names none, and none are written; groups of lines named open... or "
        "land... become such");
  }
  return sentences;
}

}  // namespace

const Codec adcirc_codec{{FileFormat::adcirc,
                          "adcirc",
                          "ADCIRC",
                          {".14", ".grd", ".gr3", ".ll"},
                          {.names = true, .collapsed_quads = false, .curved_cells = false, .empty_groups = false}},
                         &read_adcirc,
                         &write_adcirc,
                         &lost_in_adcirc};

}  // namespace trismooth
