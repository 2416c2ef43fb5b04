// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/flat_points.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/place_values.h"
#include "trismooth/mesh_io/sms/sms_elements.h"
#include "trismooth/mesh_io/sms/sms_reader.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

const SmsElement* sms_element_of(std::uint8_t type) {
  const auto* const found = std::ranges::find(sms_elements, type, &SmsElement::type);
  return found == sms_elements.end() ? nullptr : found;
}

/// Nothing where none can be written: a name in quotation marks has none in it.
bool is_material_name(const std::string& name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '"'; });
}

/// The names of the materials. Where faces and lines have one number, the name is that of the faces, if any.
std::map<std::int64_t, std::string> written_materials(const CellGroups& groups) {
  std::map<std::int64_t, std::string> names;
  for (const int dimension : {2, 1}) {
    for (const CellGroup& group : groups.groups) {
      if (group.dimension == dimension) {
        names.emplace(group.number, is_material_name(group.name) ? group.name : "");
      }
    }
  }
  std::erase_if(names, [](const auto& material) { return material.second.empty(); });
  return names;
}

void write_nodestrings(TextMeshWriter& writer, const MeshDocument& document) {
  constexpr std::size_t most_nodes = 10;
  std::size_t number = 0;
  for (const NamedSet& set : document.point_sets) {
    const std::size_t size = set.members.size();
    number += size > 0 ? 1 : 0;
    writer.write_lines((size + most_nodes - 1) / most_nodes, [&](TextLines& lines, std::size_t row) {
      lines.word("NS");
      for (std::size_t i = row * most_nodes; i < std::min(size, (row + 1) * most_nodes); ++i) {
        const std::int64_t node = std::int64_t{set.members[i]} + 1;
        lines.number(i + 1 == size ? -node : node);
      }
      if ((row + 1) * most_nodes >= size) {
        lines.number(number);
      }
      lines.end_line();
    });
  }
}

void write_sms(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  const CellGroups groups = find_cell_groups(document);
  const PlaceValues elevations = find_place_values(document, PlaceValue::elevation);
  std::vector<std::size_t> written;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (sms_element_of(cells.types[cell]) != nullptr) {
      written.push_back(cell);
    }
  }
  TextMeshWriter writer(path, workers);
  writer.write_line([](TextLines& line) { line.word("MESH2D"); });
  writer.write_line([](TextLines& line) { line.word("NUM_MATERIALS_PER_ELEM").number(1); });
  writer.write_lines(written.size(), [&](TextLines& lines, std::size_t i) {
    const std::size_t cell = written[i];
    const SmsElement& element = *sms_element_of(cells.types[cell]);
    lines.word(element.card).number(i + 1);
    std::array<std::int64_t, most_sms_nodes> nodes{};
    for (std::size_t k = 0; k < element.nodes; ++k) {
      nodes.at(element.order.at(k)) = std::int64_t{cells[cell][k]} + 1;
    }
    for (std::size_t k = 0; k < element.nodes; ++k) {
      lines.number(nodes.at(k));
    }
    const std::int32_t group = groups.of_cell.empty() ? -1 : groups.of_cell[cell];
    lines.number(group < 0 ? 0 : groups.groups[static_cast<std::size_t>(group)].number).end_line();
  });
  writer.write_lines(document.point_count(), [&](TextLines& lines, std::size_t i) {
    const double z = elevations.array.empty() ? document.points[3 * i + 2] : elevations.values[i];
    lines.word("ND").number(i + 1).number(document.points[3 * i]).number(document.points[3 * i + 1]);
    lines.number(z).end_line();
  });
  write_nodestrings(writer, document);
  for (const auto& [number, name] : written_materials(groups)) {
    writer.write_line(
        [number = number, &name = name](TextLines& line) { line.word("MAT").number(number).word("\"" + name + "\""); });
  }
  writer.close();
}

/// Names of materials that are not written.
std::vector<std::string> lost_material_names(const CellGroups& groups) {
  const auto written = written_materials(groups);
  std::string lost;
  std::string named;
  for (const CellGroup& group : groups.groups) {
    const auto found = written.find(group.number);
    if (!group.name.empty() && (found == written.end() || found->second != group.name)) {
      add_to_list(lost, group.name);
    }
    if (group.dimension == 1 && group.name.empty() && found != written.end()) {
      add_to_list(named, std::to_string(group.number) + " (" + found->second + ")");
    }
  }
  std::vector<std::string> sentences;
  if (!lost.empty()) {
    sentences.push_back("2dm holds one name for a number of materials, without quotation marks: not written are " +
                        lost);
  }
  if (!named.empty()) {
    sentences.push_back(
        "2dm holds one name for a number of materials: lines without a name get that of the faces of "
        "their number: " +
        named);
  }
  return sentences;
}

std::vector<std::string> lost_set_names(const MeshDocument& document) {
  std::string lost;
  std::size_t number = 0;
  for (const NamedSet& set : document.point_sets) {
    number += set.members.empty() ? 0 : 1;
    if (set.members.empty() || set.name != "nodestring " + std::to_string(number)) {
      add_to_list(lost, shown_name(set));
    }
  }
  return lost.empty() ? std::vector<std::string>{}
                      : std::vector<std::string>{
                            "2dm numbers nodestrings, which have nodes: the names of sets of points, or empty sets, "
                            "are not written: " +
                            lost};
}

std::vector<std::string> lost_in_sms(const MeshDocument& document) {
  const CellGroups groups = find_cell_groups(document);
  const std::string elevations = find_place_values(document, PlaceValue::elevation).array;
  MeshDocument lost;
  lost.cell_sets = document.cell_sets;
  std::vector<std::uint8_t> types(sms_elements.size());
  std::ranges::transform(sms_elements, types.begin(), &SmsElement::type);
  std::vector<std::string> sentences =
      describe_lost_cells("2dm", "triangles, quadrilaterals and lines", types, document.cells);
  for (std::vector<std::string> more :
       {describe_lost_arrays("2dm", document, {.point = elevations, .cell = groups.arrays}),
        describe_lost_sets("2dm", lost), lost_material_names(groups), lost_set_names(document),
        elevations.empty() ? std::vector<std::string>{} : describe_lost_z("2dm", document)}) {
    std::ranges::move(more, std::back_inserter(sentences));
  }
  return sentences;
}

bool recognises_sms(std::string_view bytes) {
  TextScanner scanner(bytes, {}, TextScanner::Comments::hash, begin_of_text(bytes));
  return scanner.peek_token() == "MESH2D";
}

}  // namespace

const Codec sms_codec{{FileFormat::sms, "2dm", "SMS 2dm", {".2dm"}, {.names = true, .empty_groups = false}},
                      &read_sms,
                      &write_sms,
                      &lost_in_sms,
                      &recognises_sms};

}  // namespace trismooth
