// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/su2/su2_writer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/cells/boundary_edges.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::array su2_types{cell_type::triangle, cell_type::quad, cell_type::line};

bool is_su2_element(std::uint8_t type) {
  return type == cell_type::triangle || type == cell_type::quad;
}

using Edge = std::array<std::int32_t, 2>;

struct Su2Marker {
  std::string name;
  std::string wanted_name;  ///< where SU2 does not take it as it is; else empty
  std::vector<Edge> edges;
};

struct Su2Markers {
  std::vector<Su2Marker> all;
  std::size_t added_edges = 0;  ///< of the last one: no lines of the document
};

/// The name as SU2 reads it: it takes blanks out, and '%' stands before comments.
std::string su2_name(std::string_view name) {
  std::string changed(name);
  std::ranges::replace_if(
      changed, [](char c) { return (0 <= c && c <= ' ') || c == '%' || c == '\x7f'; }, '_');
  return changed;
}

Su2Markers find_markers(const MeshDocument& document) {
  const CellGroups groups = find_cell_groups(document);
  const CellList& cells = document.cells;
  Su2Markers found;
  std::vector<std::size_t> marker_of_group(groups.groups.size());
  FreeNames names;
  for (const CellGroup& group : groups.groups) {
    if (group.dimension == 1 && su2_name(group.name) == group.name) {
      names.take(group.name);
    }
  }
  FreeNames used;
  for (std::size_t i = 0; i < groups.groups.size(); ++i) {
    const CellGroup& group = groups.groups[i];
    if (group.dimension != 1) {
      continue;
    }
    marker_of_group[i] = found.all.size();
    Su2Marker& marker = found.all.emplace_back();
    if (group.name.empty()) {
      marker.name = names.claim("marker_" + std::to_string(group.number));
      continue;
    }
    const bool is_kept = su2_name(group.name) == group.name && used.claim(group.name) == group.name;
    marker.name = is_kept ? group.name : names.claim(su2_name(group.name));
    marker.wanted_name = is_kept ? "" : group.name;
  }
  Su2Marker rest;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells.types[cell] == cell_type::line) {
      const std::int32_t group = groups.of_cell.empty() ? -1 : groups.of_cell[cell];
      Su2Marker& marker = group < 0 ? rest : found.all[marker_of_group[static_cast<std::size_t>(group)]];
      marker.edges.push_back({cells[cell][0], cells[cell][1]});
    }
  }
  // Groups of other curves than lines are not held.
  std::erase_if(found.all, [](const Su2Marker& marker) { return marker.edges.empty(); });
  const std::vector<Edge> more = find_boundary_edges(cells);
  found.added_edges = more.size();
  rest.edges.insert(rest.edges.end(), more.begin(), more.end());
  if (!rest.edges.empty()) {
    rest.name = names.claim("boundary");
    found.all.push_back(std::move(rest));
  }
  return found;
}

std::vector<std::string> describe_markers(const Su2Markers& markers) {
  std::vector<std::string> sentences;
  std::string renamed;
  for (const Su2Marker& marker : markers.all) {
    if (!marker.wanted_name.empty()) {
      add_to_list(renamed, trismooth::quoted(marker.wanted_name) + " is " + marker.name);
    }
  }
  if (!renamed.empty()) {
    sentences.push_back("SU2 takes names without blanks and '%', each once: " + renamed);
  }
  if (markers.added_edges > 0) {
    const bool one = markers.added_edges == 1;
    sentences.push_back(
        "SU2 needs markers: the " + (one ? std::string("edge") : std::to_string(markers.added_edges) + " edges") +
        " with one element and no line " + (one ? "is" : "are") + " written as the marker " + markers.all.back().name);
  }
  return sentences;
}

/// The arrays, but for that of the groups that are written as markers: of it, groups of other cells are lost.
std::vector<std::string> describe_lost_in_arrays(const MeshDocument& document) {
  const CellGroups groups = find_cell_groups(document);
  const bool has_markers =
      std::ranges::any_of(groups.groups, [](const CellGroup& group) { return group.dimension == 1; });
  HeldArrays held;
  if (has_markers) {
    held.cell.of_dimension[1] = groups.arrays.of_dimension[1];
  }
  std::vector<std::string> sentences = describe_lost_arrays("SU2", document, held);
  // A value of 0 without a name, of all other cells, says nothing.
  const bool has_others = std::ranges::any_of(groups.groups, [&](const CellGroup& group) {
    const std::string& array = groups.arrays.of_dimension.at(static_cast<std::size_t>(group.dimension));
    return group.dimension != 1 && held.cell.has(array) && (group.number != 0 || !group.name.empty());
  });
  if (has_markers && has_others) {
    sentences.push_back("SU2 holds groups of lines only, as markers: what " + groups.arrays.of_dimension[1] +
                        " says of other cells is not written");
  }
  return sentences;
}

}  // namespace

void write_su2(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  require_flat_points(path, "SU2", document);
  const CellList& cells = document.cells;
  const Su2Markers markers = find_markers(document);
  const auto write_count = [](TextMeshWriter& writer, std::string_view keyword, std::size_t count) {
    writer.write_line([&](TextLines& line) { line.word(keyword).number(count); });
  };
  TextMeshWriter writer(path, workers);
  write_count(writer, "NDIME=", 2);
  write_count(writer, "NPOIN=", document.point_count());
  writer.write_lines(document.point_count(), [&points = document.points](TextLines& lines, std::size_t i) {
    lines.number(points[3 * i]).number(points[3 * i + 1]).end_line();
  });
  write_count(writer, "NELEM=", static_cast<std::size_t>(std::ranges::count_if(cells.types, &is_su2_element)));
  writer.write_lines(cells.size(), [&cells](TextLines& lines, std::size_t cell) {
    if (is_su2_element(cells.types[cell])) {
      lines.number(int{cells.types[cell]});
      for (const std::int32_t vertex : cells[cell]) {
        lines.number(vertex);
      }
      lines.end_line();
    }
  });
  write_count(writer, "NMARK=", markers.all.size());
  for (const Su2Marker& marker : markers.all) {
    writer.write_line([&](TextLines& line) { line.word("MARKER_TAG=").word(marker.name); });
    write_count(writer, "MARKER_ELEMS=", marker.edges.size());
    writer.write_lines(marker.edges.size(), [&marker](TextLines& lines, std::size_t i) {
      lines.number(int{cell_type::line}).number(marker.edges[i][0]).number(marker.edges[i][1]).end_line();
    });
  }
  writer.close();
}

std::vector<std::string> lost_in_su2(const MeshDocument& document) {
  std::vector<std::string> sentences = describe_lost_z("SU2", document);
  std::ranges::move(describe_lost_cells("SU2", "triangles, quads and lines", su2_types, document.cells),
                    std::back_inserter(sentences));
  std::ranges::move(describe_lost_in_arrays(document), std::back_inserter(sentences));
  std::ranges::move(describe_lost_sets("SU2", document), std::back_inserter(sentences));
  std::ranges::move(describe_markers(find_markers(document)), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
