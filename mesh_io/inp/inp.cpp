// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/inp/inp_element_types.h"
#include "trismooth/mesh_io/inp/inp_names.h"
#include "trismooth/mesh_io/inp/inp_reader.h"
#include "trismooth/mesh_io/inp/inp_text.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"

namespace trismooth {

namespace {

constexpr std::size_t most_inp_characters = 20;

/// A set as it is written: members are numbers from 1.
struct WrittenInpSet {
  std::string name;
  std::vector<std::int32_t> members;
};

/// The sets of a document as the file gets them.
struct WrittenInpSets {
  InpSetNames cell_names;
  InpSetNames point_names;
  std::vector<WrittenInpSet> of_cells;
  std::vector<WrittenInpSet> of_points;
  GroupArrays arrays;  ///< whose groups they are from
};

bool is_point_cell(std::uint8_t type) {
  return type == cell_type::vertex || type == cell_type::poly_vertex;
}

std::string group_name(const CellGroups& groups, const CellGroup& group) {
  const std::string& array = groups.arrays.of_dimension.at(static_cast<std::size_t>(group.dimension));
  return group.name.empty() ? array + "_" + std::to_string(group.number) : group.name;
}

/// Adds the cells as an element set, and vertex cells among them as a node set.
void add_set(const CellList& cells, const std::string& name, const std::vector<std::int32_t>& members,
             WrittenInpSets& sets) {
  WrittenInpSet of_cells;
  WrittenInpSet of_points;
  for (const std::int32_t member : members) {
    const auto cell = static_cast<std::size_t>(member);
    if (is_point_cell(cells.types[cell])) {
      of_points.members.insert(of_points.members.end(), cells[cell].begin(), cells[cell].end());
    } else if (!inp_type_of_cell(cells.types[cell]).empty()) {
      of_cells.members.push_back(member);
    }
  }
  if (!of_cells.members.empty()) {
    of_cells.name = sets.cell_names.claim(name);
    sets.of_cells.push_back(std::move(of_cells));
  }
  if (!of_points.members.empty()) {
    of_points.name = sets.point_names.claim(name);
    sets.of_points.push_back(std::move(of_points));
  }
}

/// Groups of cells, and sets of these, become element sets; sets of points and groups of vertex cells node sets. An
/// element may be in several: a group that a set has whole is that set.
WrittenInpSets written_sets(const MeshDocument& document) {
  WrittenInpSets sets;
  const CellGroups groups = find_cell_groups(document);
  sets.arrays = groups.arrays;
  std::vector<std::vector<std::int32_t>> members(groups.groups.size());
  for (std::size_t cell = 0; cell < groups.of_cell.size(); ++cell) {
    if (groups.of_cell[cell] >= 0) {
      members[static_cast<std::size_t>(groups.of_cell[cell])].push_back(static_cast<std::int32_t>(cell));
    }
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (groups.groups[i].whole_set < 0) {
      add_set(document.cells, group_name(groups, groups.groups[i]), members[i], sets);
    }
  }
  for (const NamedSet& set : document.cell_sets) {
    add_set(document.cells, set.name, set.members, sets);
  }
  for (const NamedSet& set : document.point_sets) {
    sets.of_points.push_back({sets.point_names.claim(set.name), set.members});
  }
  return sets;
}

void write_coordinate(TextBlock& text, double value) {
  std::array<char, 32> number{};
  text.text(", ").text({number.data(), write_within(value, most_inp_characters, number.data())});
}

/// Numbers from 1, and where the middle of a curve stands in the middle.
void write_element(TextBlock& text, const CellList& cells, std::size_t cell) {
  text.number(cell + 1);
  const auto vertices = cells[cell];
  const auto add = [&](std::size_t i) { text.text(", ").number(std::int64_t{vertices[i]} + 1); };
  if (cells.types[cell] == cell_type::quadratic_edge) {
    add(0);
    add(2);
    add(1);
  } else {
    constexpr std::size_t most_in_line = 15;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i == most_in_line) {
        text.text(",\n").number(std::int64_t{vertices[i]} + 1);
      } else {
        add(i);
      }
    }
  }
  text.text("\n");
}

void write_sets(TextMeshWriter& writer, std::string_view keyword, const std::vector<WrittenInpSet>& sets) {
  constexpr std::size_t most_in_line = 16;
  for (const WrittenInpSet& set : sets) {
    if (set.members.empty()) {
      continue;
    }
    writer.write_text(std::string(keyword) + set.name + "\n");
    const std::size_t lines = (set.members.size() + most_in_line - 1) / most_in_line;
    writer.write_rows(lines, [&set](TextBlock& text, std::size_t line) {
      const std::size_t end = std::min((line + 1) * most_in_line, set.members.size());
      for (std::size_t i = line * most_in_line; i < end; ++i) {
        text.number(std::int64_t{set.members[i]} + 1).text(i + 1 < end ? ", " : "\n");
      }
    });
  }
}

void write_inp(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  TextMeshWriter writer(path, workers);
  writer.write_text("*HEADING\nwritten by trismooth\n*NODE\n");
  writer.write_rows(document.point_count(), [&points = document.points](TextBlock& text, std::size_t i) {
    text.number(i + 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      write_coordinate(text, points[3 * i + axis]);
    }
    text.text("\n");
  });
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin;
    while (end < cells.size() && cells.types[end] == cells.types[begin]) {
      ++end;
    }
    const std::string_view type = inp_type_of_cell(cells.types[begin]);
    if (!type.empty()) {
      writer.write_text("*ELEMENT, TYPE=" + std::string(type) + "\n");
      writer.write_rows(end - begin,
                        [&cells, begin](TextBlock& text, std::size_t i) { write_element(text, cells, begin + i); });
    }
    begin = end;
  }
  const WrittenInpSets sets = written_sets(document);
  write_sets(writer, "*ELSET, ELSET=", sets.of_cells);
  write_sets(writer, "*NSET, NSET=", sets.of_points);
  writer.close();
}

/// Of vertex cells those are written that are in a group or a set: as a node set.
CellList cells_to_tell_of(const MeshDocument& document, const CellGroups& groups) {
  CellList cells;
  std::vector<bool> is_in_set(document.cells.size());
  for (const NamedSet& set : document.cell_sets) {
    for (const std::int32_t cell : set.members) {
      is_in_set[static_cast<std::size_t>(cell)] = true;
    }
  }
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const std::uint8_t type = document.cells.types[cell];
    if (inp_type_of_cell(type).empty() &&
        !(is_point_cell(type) && (is_in_set[cell] || (!groups.of_cell.empty() && groups.of_cell[cell] >= 0)))) {
      cells.append(type, {});
    }
  }
  return cells;
}

std::vector<std::string> lost_in_inp(const MeshDocument& document) {
  const WrittenInpSets sets = written_sets(document);
  std::vector<std::string> sentences = describe_lost_cells("Abaqus", "lines, faces and solids", {},
                                                           cells_to_tell_of(document, find_cell_groups(document)));
  std::ranges::move(describe_lost_arrays("Abaqus", document, {.cell = sets.arrays}), std::back_inserter(sentences));
  const auto tell_of = [&](std::string_view rule, const std::vector<std::string>& (InpSetNames::*names)() const) {
    std::string all;
    for (const InpSetNames* const taken : {&sets.cell_names, &sets.point_names}) {
      for (const std::string& name : (taken->*names)()) {
        add_to_list(all, name);
      }
    }
    if (!all.empty()) {
      sentences.push_back("Abaqus holds " + std::string(rule) + ": changed are " + all);
    }
  };
  tell_of("names of up to 60 letters, digits, _ and -, a letter first", &InpSetNames::rewritten);
  tell_of("each name once, whatever the case of its letters", &InpSetNames::repeated);
  return sentences;
}

/// The first line that says anything is a keyword that input files begin with, or a comment of theirs before one.
bool is_inp(std::string_view bytes) {
  constexpr auto first_keywords =
      std::to_array<std::string_view>({"HEADING", "NODE", "ELEMENT", "PART", "ASSEMBLY", "NSET", "ELSET", "INCLUDE",
                                       "PREPRINT", "MATERIAL", "PARAMETER", "RESTART", "SYSTEM"});
  InpLines lines(bytes);
  return lines.next() == InpLines::Kind::keyword &&
         std::ranges::find(first_keywords, lines.keyword().name) != first_keywords.end();
}

}  // namespace

const Codec inp_codec{{FileFormat::inp, "inp", "Abaqus", {".inp"}, {.names = true, .empty_groups = false}},
                      &read_inp,
                      &write_inp,
                      &lost_in_inp,
                      &is_inp};

}  // namespace trismooth
