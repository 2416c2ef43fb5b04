// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/document/cells/other_cells.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/nastran/nastran_card.h"
#include "trismooth/mesh_io/nastran/nastran_elements.h"
#include "trismooth/mesh_io/nastran/nastran_names.h"
#include "trismooth/mesh_io/nastran/nastran_original.h"
#include "trismooth/mesh_io/nastran/nastran_reader.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_mesh_writer.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// A number of Nastran has 8 digits at most.
constexpr std::int64_t most_nastran_number = 99'999'999;

/// The properties that cells get.
struct WrittenProperties {
  CellGroups groups;
  std::vector<std::int64_t> of_group;
  std::int64_t of_others = 1;                 ///< of cells without a group
  std::map<std::int64_t, std::string> names;  ///< of properties
  std::vector<std::string> renumbered;        ///< "3 (as 4)": groups that do not get their number
};

/// A property is of one dimension: of faces first, where groups share a number.
WrittenProperties written_properties(const MeshDocument& document) {
  WrittenProperties written;
  written.groups = find_cell_groups(document);
  const std::vector<CellGroup>& groups = written.groups.groups;
  written.of_group.assign(groups.size(), 0);
  std::set<std::int64_t> taken;
  for (const int dimension : {2, 1, 3}) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const std::int64_t number = groups[i].number;
      if (groups[i].dimension == dimension && number > 0 && number <= most_nastran_number &&
          taken.insert(number).second) {
        written.of_group[i] = number;
      }
    }
  }
  std::int64_t next = 1;
  const auto claim = [&] {
    while (!taken.insert(next).second) {
      ++next;
    }
    return next;
  };
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].dimension == 0) {
      continue;
    }
    if (written.of_group[i] == 0) {
      written.of_group[i] = claim();
      written.renumbered.push_back((groups[i].name.empty() ? "" : groups[i].name + " ") +
                                   std::to_string(groups[i].number) + " (as " + std::to_string(written.of_group[i]) +
                                   ")");
    }
    if (is_nastran_name(groups[i].name)) {
      written.names.emplace(written.of_group[i], groups[i].name);
    }
  }
  written.of_others = claim();
  return written;
}

std::int64_t property_of(const WrittenProperties& properties, std::size_t cell) {
  const std::int32_t group = properties.groups.of_cell.empty() ? -1 : properties.groups.of_cell[cell];
  return group < 0 ? properties.of_others : properties.of_group[static_cast<std::size_t>(group)];
}

/// Appends fields of whole numbers, in lines of `count` fields of `width` columns.
class FieldWriter {
 public:
  FieldWriter(TextBlock& text, std::string_view name, bool is_large) : text_(text), is_large_(is_large) {
    append(std::string(name) + (is_large ? "*" : ""), nastran_head_columns);
  }

  FieldWriter& number(std::int64_t value) {
    const std::size_t count = is_large_ ? most_nastran_fields / 2 : most_nastran_fields;
    if (fields_ > 0 && fields_ % count == 0) {
      text_.text('\n');
      append(is_large_ ? "*" : "+", nastran_head_columns);
    }
    ++fields_;
    append(std::to_string(value), is_large_ ? 16 : 8);
    return *this;
  }
  void end() { text_.text('\n'); }

 private:
  void append(std::string field, std::size_t columns) {
    field.resize(std::max(columns, field.size()), ' ');
    text_.text(field);
  }

  TextBlock& text_;
  bool is_large_;
  std::size_t fields_ = 0;
};

void write_grid(TextBlock& text, std::int64_t id, const double* point) {
  const auto number = [&text](double value, bool has_more) {
    std::array<char, 32> digits{};
    std::string field(digits.data(), write_within(value, most_nastran_characters, NumberForm::nastran, digits.data()));
    field.resize(has_more ? std::max(field.size(), most_nastran_characters) : field.size(), ' ');
    text.text(field);
  };
  std::string head = std::to_string(id);
  head.resize(2 * most_nastran_characters, ' ');
  text.text("GRID*   ").text(head);
  number(point[0], true);
  number(point[1], false);
  text.text("\n*       ");
  number(point[2], false);
  text.text('\n');
}

void write_nastran(const std::filesystem::path& path, const MeshDocument& document, const FileWorkers& workers) {
  const CellList& cells = document.cells;
  const WrittenProperties properties = written_properties(document);
  std::vector<std::size_t> written;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (nastran_element_of_cell(cells.types[cell]) != nullptr) {
      written.push_back(cell);
    }
  }
  TextMeshWriter writer(path, workers);
  writer.write_text("$ written by trismooth\nBEGIN BULK\n");
  for (const auto& [number, name] : properties.names) {
    writer.write_text(nastran_name_comment(number, name) + "\n");
  }
  writer.write_rows(document.point_count(), [&points = document.points](TextBlock& text, std::size_t i) {
    write_grid(text, static_cast<std::int64_t>(i) + 1, points.data() + 3 * i);
  });
  const bool is_large =
      static_cast<std::int64_t>(std::max(document.point_count(), written.size())) > most_nastran_number;
  writer.write_rows(written.size(), [&](TextBlock& text, std::size_t i) {
    const std::size_t cell = written[i];
    const std::uint8_t type = cells.types[cell];
    const NastranElement& element = *nastran_element_of_cell(type);
    const NastranShape& shape = element.shape_of(type);
    const auto vertices = cells[cell];
    std::array<std::int32_t, most_nastran_nodes> nodes{};
    for (std::size_t k = 0; k < shape.nodes; ++k) {
      nodes.at(shape.place(k)) = vertices[k];
    }
    FieldWriter fields(text, element.name, is_large);
    fields.number(static_cast<std::int64_t>(i) + 1).number(property_of(properties, cell));
    for (std::size_t k = 0; k < shape.nodes; ++k) {
      fields.number(std::int64_t{nodes.at(k)} + 1);
    }
    fields.end();
  });
  writer.write_text("ENDDATA\n");
  writer.close();
}

std::vector<std::string> lost_in_nastran(const MeshDocument& document) {
  const WrittenProperties properties = written_properties(document);
  const auto nastran_types =
      cell_types_where([](std::uint8_t type) { return nastran_element_of_cell(type) != nullptr; });
  std::vector<std::string> sentences =
      describe_lost_cells("Nastran", "lines, faces and solids", nastran_types, document.cells);
  for (std::vector<std::string> more : {describe_lost_arrays("Nastran", document, {.cell = properties.groups.arrays}),
                                        describe_lost_sets("Nastran", document)}) {
    std::ranges::move(more, std::back_inserter(sentences));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < properties.of_group.size(); ++i) {
    const CellGroup& group = properties.groups.groups[i];
    const auto named = properties.names.find(properties.of_group[i]);
    if (!group.name.empty() && (named == properties.names.end() || named->second != group.name)) {
      names.push_back(group.name);
    }
  }
  if (!names.empty()) {
    sentences.push_back(
        "Nastran has names of properties in comments, of lines, faces and solids, without quotation "
        "marks: not written are " +
        list_text(names));
  }
  if (!properties.renumbered.empty()) {
    sentences.push_back("Nastran numbers properties from 1 to 99999999, each of one dimension: changed are " +
                        list_text(properties.renumbered));
  }
  return sentences;
}

/// Before anything else but comments and blank lines stands a word that begins a deck, or a card that bulk data have.
bool is_nastran(std::string_view bytes) {
  constexpr auto first_words = std::to_array<std::string_view>({"SOL", "CEND", "NASTRAN", "ASSIGN", "ID"});
  NastranLines lines(bytes, begin_of_text(bytes));
  bool is_control = false;
  while (lines.next()) {
    const std::string_view line = lines.line();
    if (is_empty_nastran_line(line)) {
      continue;
    }
    if (begins_with_nastran_word(line, "BEGIN")) {
      return nastran_key(line).find("BULK") != std::string::npos;
    }
    if (is_control) {
      continue;
    }
    is_control = std::ranges::any_of(first_words,
                                     [line](std::string_view word) { return begins_with_nastran_word(line, word); });
    if (is_control) {
      continue;
    }
    const NastranLine card = divide_nastran_line(line);
    const std::string name = card.name();
    return (name == "GRID" || find_nastran_element(name) != nullptr) && parse_integer(trimmed(card.fields[0]));
  }
  return false;
}

}  // namespace

const Codec nastran_codec{{FileFormat::nastran, "nastran", "Nastran", {".bdf", ".nas"}, {.names = true}},
                          &read_nastran,
                          &write_nastran,
                          &lost_in_nastran,
                          &is_nastran};

}  // namespace trismooth
