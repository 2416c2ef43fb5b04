// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/unv/unv_elements.h"
#include "trismooth/mesh_io/unv/unv_reader.h"

namespace trismooth {

namespace {

constexpr std::size_t unv_integer_columns = 10;
constexpr std::size_t unv_number_columns = 25;

TextBlock& unv_integer(TextBlock& text, std::int64_t value) {
  const std::string digits = std::to_string(value);
  // Between numbers of more digits than the format has columns for stands a blank.
  text.text(std::string(std::max(unv_integer_columns, digits.size() + 1) - digits.size(), ' '));
  return text.text(digits);
}

/// Integers, eight to a line.
template <class Value>
void unv_integers(TextBlock& text, std::size_t count, const Value& value) {
  constexpr std::size_t most_in_line = 8;
  for (std::size_t i = 0; i < count; ++i) {
    unv_integer(text, value(i));
    if (i + 1 == count || (i + 1) % most_in_line == 0) {
      text.text('\n');
    }
  }
}

/// What a group is written with.
struct WrittenGroup {
  std::int64_t number = 0;
  std::string name = {};
  std::vector<std::int32_t> points = {};
  std::vector<std::int32_t> elements = {};  ///< places among those that are written
  std::vector<std::int32_t> apart = {};     ///< of these, those that are in no other group's list of such
};

/// A name stands on a line of its own, and is read without blanks around it.
std::string unv_name(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return static_cast<unsigned char>(c) < ' '; }, '_');
  const std::size_t first = name.find_first_not_of(' ');
  return first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(' ') + 1 - first);
}

/// Cells that are written, and the place of each cell among them: -1 for others.
struct WrittenElements {
  std::vector<std::size_t> cells;
  std::vector<std::int32_t> places;
};

WrittenElements written_elements(const CellList& cells) {
  WrittenElements written;
  written.places.assign(cells.size(), -1);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (unv_shape_of_cell(cells.types[cell]).nodes == cells[cell].size()) {
      written.places[cell] = static_cast<std::int32_t>(written.cells.size());
      written.cells.push_back(cell);
    }
  }
  return written;
}

/// "1 (a) to 3": a group that is written under another number than its own.
std::string renumbered(std::int64_t from, const WrittenGroup& group) {
  return std::to_string(from) + (group.name.empty() ? "" : " (" + group.name + ")") + " to " +
         std::to_string(group.number);
}

/// Groups of cells under their numbers; where these are taken, or none, as sets are, under further ones. `changed`,
/// where it is not null, gets those that have a number and are written under another one.
std::vector<WrittenGroup> written_groups(const MeshDocument& document, const CellGroups& groups,
                                         const WrittenElements& elements, std::vector<std::string>* changed = nullptr) {
  std::vector<WrittenGroup> written;
  std::set<std::int64_t> taken;
  std::vector<std::size_t> of_group(groups.groups.size());
  // One group where lines and faces share number and name.
  std::map<std::pair<std::int64_t, std::string>, std::size_t> known;
  for (std::size_t i = 0; i < groups.groups.size(); ++i) {
    const CellGroup& group = groups.groups[i];
    const auto [place, is_new] = known.try_emplace({group.number, unv_name(group.name)}, written.size());
    of_group[i] = place->second;
    if (is_new) {
      written.push_back({.number = group.number, .name = unv_name(group.name)});
    }
  }
  std::vector<std::int64_t> numbers;
  for (WrittenGroup& group : written) {
    numbers.push_back(group.number);
    if (group.number < 1 || !taken.insert(group.number).second) {
      group.number = 0;
    }
  }
  // A group that a set has whole gets the cells of the set.
  std::vector<std::optional<std::size_t>> group_of_set(document.cell_sets.size());
  std::vector<bool> is_whole_set(groups.groups.size());
  for (std::size_t i = 0; i < groups.groups.size(); ++i) {
    if (const std::int32_t set = groups.groups[i].whole_set; set >= 0) {
      std::optional<std::size_t>& group = group_of_set[static_cast<std::size_t>(set)];
      group = group.value_or(of_group[i]);
      is_whole_set[i] = *group == of_group[i];
    }
  }
  // Points that are cells are nodes of a group.
  const auto add = [&](WrittenGroup& group, std::size_t cell) {
    if (elements.places[cell] >= 0) {
      group.elements.push_back(elements.places[cell]);
    } else if (document.cells.types[cell] == cell_type::vertex) {
      group.points.push_back(document.cells[cell][0]);
    }
  };
  for (std::size_t cell = 0; cell < groups.of_cell.size(); ++cell) {
    if (groups.of_cell[cell] >= 0) {
      const auto i = static_cast<std::size_t>(groups.of_cell[cell]);
      if (elements.places[cell] >= 0) {
        written[of_group[i]].apart.push_back(elements.places[cell]);
      }
      if (!is_whole_set[i]) {
        add(written[of_group[i]], cell);
      }
    }
  }
  for (std::size_t i = 0; i < document.cell_sets.size(); ++i) {
    const NamedSet& set = document.cell_sets[i];
    if (!group_of_set[i]) {
      written.push_back({.name = unv_name(set.name)});
    }
    WrittenGroup& group = group_of_set[i] ? written[*group_of_set[i]] : written.back();
    for (const std::int32_t cell : set.members) {
      add(group, static_cast<std::size_t>(cell));
    }
  }
  for (const NamedSet& set : document.point_sets) {
    written.push_back({.name = unv_name(set.name), .points = set.members});
  }
  std::int64_t next = 1;
  for (WrittenGroup& group : written) {
    if (group.number == 0) {
      while (!taken.insert(next).second) {
        ++next;
      }
      group.number = next;
    }
  }
  for (std::size_t i = 0; changed != nullptr && i < numbers.size(); ++i) {
    if (written[i].number != numbers[i]) {
      changed->push_back(renumbered(numbers[i], written[i]));
    }
  }
  return written;
}

/// The property of each element: the number of its group, or 0. Programs tell regions apart by it.
std::vector<std::int64_t> written_properties(const std::vector<WrittenGroup>& groups, std::size_t elements) {
  std::vector<std::int64_t> properties(elements);
  for (const WrittenGroup& group : groups) {
    for (const std::int32_t element : group.apart) {
      properties[static_cast<std::size_t>(element)] = group.number;
    }
  }
  return properties;
}

void write_group(TextMeshWriter& writer, const WrittenGroup& group) {
  constexpr std::size_t members_in_line = 2;
  const std::size_t members = group.points.size() + group.elements.size();
  writer.write_rows(1, [&](TextBlock& text, std::size_t /*row*/) {
    unv_integers(text, 8, [&](std::size_t i) {
      return i == 0 ? group.number : i == 7 ? static_cast<std::int64_t>(members) : 0;
    });
    text.text(group.name.empty() ? "group " + std::to_string(group.number) : group.name).text('\n');
  });
  writer.write_rows((members + members_in_line - 1) / members_in_line, [&](TextBlock& text, std::size_t row) {
    const std::size_t last = std::min(members, members_in_line * (row + 1));
    for (std::size_t i = members_in_line * row; i < last; ++i) {
      const bool is_point = i < group.points.size();
      unv_integer(text, is_point ? 7 : 8);
      unv_integer(text, 1 + std::int64_t{is_point ? group.points[i] : group.elements[i - group.points.size()]});
      unv_integer(unv_integer(text, 0), 0);
    }
    text.text('\n');
  });
}

void write_unv(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  const WrittenElements elements = written_elements(cells);
  const std::vector<WrittenGroup> groups = written_groups(document, find_cell_groups(document), elements);
  const std::vector<std::int64_t> properties = written_properties(groups, elements.cells.size());
  TextMeshWriter writer(path, workers);
  writer.write_text("    -1\n  2411\n");
  writer.write_rows(document.point_count(), [&points = document.points](TextBlock& text, std::size_t i) {
    constexpr std::int64_t system = 1;
    constexpr std::int64_t colour = 11;
    unv_integer(unv_integer(text, static_cast<std::int64_t>(i) + 1), system);
    unv_integer(unv_integer(text, system), colour).text('\n');
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string number = fortran_text(points[3 * i + axis], 'D');
      text.text(std::string(unv_number_columns - number.size(), ' ')).text(number);
    }
    text.text('\n');
  });
  writer.write_text("    -1\n    -1\n  2412\n");
  writer.write_rows(elements.cells.size(), [&](TextBlock& text, std::size_t i) {
    const std::size_t cell = elements.cells[i];
    const UnvShape& shape = unv_shape_of_cell(cells.types[cell]);
    constexpr std::int64_t material = 0;
    constexpr std::int64_t colour = 7;
    const std::array<std::int64_t, 6> head{
        static_cast<std::int64_t>(i) + 1,      shape.descriptor, properties[i], material, colour,
        static_cast<std::int64_t>(shape.nodes)};
    unv_integers(text, head.size(), [&head](std::size_t k) { return head.at(k); });
    if (is_unv_beam(shape.descriptor)) {
      unv_integers(text, 3, [](std::size_t /*k*/) { return std::int64_t{0}; });
    }
    std::array<std::int64_t, most_unv_nodes> nodes{};
    for (std::size_t k = 0; k < shape.nodes; ++k) {
      nodes.at(shape.place(k)) = std::int64_t{cells[cell][k]} + 1;
    }
    unv_integers(text, shape.nodes, [&nodes](std::size_t k) { return nodes.at(k); });
  });
  writer.write_text("    -1\n");
  if (!groups.empty()) {
    // Of the data sets for groups, which are alike, the one that Gmsh reads.
    writer.write_text("    -1\n  2477\n");
    for (const WrittenGroup& group : groups) {
      write_group(writer, group);
    }
    writer.write_text("    -1\n");
  }
  writer.close();
}

std::vector<std::string> lost_in_unv(const MeshDocument& document) {
  const CellGroups groups = find_cell_groups(document);
  const auto unv_types = cell_types_where([](std::uint8_t type) { return unv_shape_of_cell(type).nodes > 0; });
  std::vector<std::string> sentences = describe_lost_cells("UNV", "lines, faces and solids", unv_types, document.cells);
  std::ranges::move(describe_lost_arrays("UNV", document, {.cell = groups.arrays}), std::back_inserter(sentences));
  std::vector<std::string> changed;
  (void)written_groups(document, groups, written_elements(document.cells), &changed);
  if (!changed.empty()) {
    sentences.push_back("UNV numbers groups from 1 on, each number once: changed are " + list_text(changed));
  }
  std::vector<std::string> renamed;
  const auto compare = [&renamed](const std::string& name) {
    if (const std::string written = unv_name(name); written != name) {
      renamed.push_back(trismooth::quoted(name) + " (as " + (written.empty() ? "its number" : written) + ")");
    }
  };
  std::ranges::for_each(groups.groups, compare, &CellGroup::name);
  std::ranges::for_each(document.cell_sets, compare, &NamedSet::name);
  std::ranges::for_each(document.point_sets, compare, &NamedSet::name);
  if (!renamed.empty()) {
    sentences.push_back("UNV has names on a line, without blanks around them: changed are " + list_text(renamed));
  }
  return sentences;
}

/// A line -1, then the number of the first data set, as text.
bool is_unv(std::string_view bytes) {
  TextScanner scanner(bytes, {}, TextScanner::Comments::none, begin_of_text(bytes));
  if (scanner.peek_token() != "-1") {
    return false;
  }
  scanner.next_token("-1");
  if (!scanner.at_end_of_line() || scanner.at_end()) {
    return false;
  }
  const auto number = parse_integer(scanner.next_token("the number of a data set"));
  return number && *number > 0 && scanner.at_end_of_line();
}

}  // namespace

const Codec unv_codec{
    {FileFormat::unv, "unv", "I-DEAS UNV", {".unv"}, {.names = true}}, &read_unv, &write_unv, &lost_in_unv, &is_unv};

}  // namespace trismooth
