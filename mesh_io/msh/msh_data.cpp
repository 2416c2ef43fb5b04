// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_data.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_row_tags.h"
#include "trismooth/mesh_io/text/blanks.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

/// More than any tensor has.
constexpr std::size_t most_msh_components = 100;

std::string without_quotes(std::string_view line) {
  line = trimmed(line);
  if (line.size() >= 2 && line.front() == '"' && line.back() == '"') {
    line = line.substr(1, line.size() - 2);
  }
  return std::string(line);
}

class MshDataReader {
 public:
  MshDataReader(MshInput& input, MshRows& rows, const MshDataSection& section, const MshTags& tags,
                const std::vector<std::int32_t>& cells, std::size_t size)
      : input_(input), rows_(rows), section_(section), tags_(tags), cells_(cells), size_(size) {}

  std::vector<double> values;
  std::vector<std::uint64_t> offsets;  ///< of every number, row by row
  std::vector<std::int32_t> of_rows;   ///< the node or cell of every row
  std::size_t named = 0;               ///< nodes or cells with a row

  void read() {
    const std::size_t numbers = section_.components * section_.rows;
    values.resize(section_.components * size_);
    of_rows.resize(section_.rows);
    if (section_.of_nodes) {
      offsets.resize(numbers);
    }
    input_.seek(section_.begin);
    if (!read_plain_rows()) {
      read_one_by_one();
    }
    std::vector<std::uint8_t> has_row(size_);
    for (const std::int32_t place : of_rows) {
      if (place >= 0 && has_row[static_cast<std::size_t>(place)] == 0) {
        has_row[static_cast<std::size_t>(place)] = 1;
        ++named;
      }
    }
  }

 private:
  std::int32_t place_of(std::int64_t tag) const {
    const std::int64_t found = tags_.find(tag);
    return static_cast<std::int32_t>(found < 0 || cells_.empty() ? found : cells_[static_cast<std::size_t>(found)]);
  }

  bool read_plain_rows() {
    const std::size_t components = section_.components;
    return rows_.read({section_.rows, 1 + components, sizeof(std::int32_t) + components * sizeof(double)},
                      [&](auto& numbers, std::size_t first, std::size_t last) {
                        bool plain = true;
                        for (std::size_t row = first; row < last && plain; ++row) {
                          std::int64_t tag = 0;
                          plain = next_tag<std::int32_t>(numbers, tag);
                          const std::int32_t place = plain ? place_of(tag) : -1;
                          of_rows[row] = place;
                          for (std::size_t i = 0; i < components && plain; ++i) {
                            double value = 0;
                            plain = numbers.next(value);
                            store(row, i, place, value, numbers.token_offset());
                          }
                        }
                        return plain;
                      });
  }

  void read_one_by_one() {
    for (std::size_t row = 0; row < section_.rows; ++row) {
      const std::int64_t tag = input_.integer("the tag of a row", 0, largest_msh_int);
      const std::int32_t place = of_rows[row] = place_of(tag);
      for (std::size_t i = 0; i < section_.components; ++i) {
        const double value = next_value();
        store(row, i, place, value, input_.number_offset());
      }
    }
  }

  /// Fields may hold what is not finite.
  double next_value() {
    if (input_.header().binary) {
      double value = 0;
      BinaryNumbers numbers(input_.bytes(), input_.offset(), input_.header().swapped);
      if (!numbers.next(value)) {
        input_.fail("expected a value, got the end of the file");
      }
      input_.text().resume(numbers.token_offset(), numbers.offset());
      return value;
    }
    const std::string_view token = input_.text().next_token("a value");
    const std::optional<double> value = parse_number<double>(token);
    if (!value) {
      input_.fail("expected a value, got " + quoted(token));
    }
    return *value;
  }

  void store(std::size_t row, std::size_t component, std::int32_t place, double value, std::size_t offset) {
    if (place >= 0) {
      values[section_.components * static_cast<std::size_t>(place) + component] = value;
    }
    if (section_.of_nodes) {
      offsets[section_.components * row + component] = offset;
    }
  }

  MshInput& input_;
  MshRows& rows_;
  const MshDataSection& section_;
  const MshTags& tags_;
  const std::vector<std::int32_t>& cells_;
  std::size_t size_;
};

}  // namespace

bool read_msh_data_header(MshInput& input, MshDataSection& section) {
  TextScanner& text = input.text();
  const auto count_of = [&](std::string_view what) { return text.next_integer(what, 0, largest_msh_int); };
  const std::int64_t texts = count_of("the number of texts of the data");
  text.next_line();
  for (std::int64_t i = 0; i < texts; ++i) {
    if (text.offset() == input.bytes().size()) {
      text.fail("expected a text of the data, got the end of the file");
    }
    const std::string_view line = text.next_line();
    section.name = i == 0 ? without_quotes(line) : section.name;
  }
  const std::int64_t reals = count_of("the number of real numbers of the data");
  for (std::int64_t i = 0; i < reals; ++i) {
    text.next_double("a real number of the data");
  }
  const std::int64_t integers = count_of("the number of whole numbers of the data");
  std::array<std::int64_t, 3> first{};  // step in time, components, rows
  for (std::int64_t i = 0; i < integers; ++i) {
    const std::int64_t value = text.next_integer("a whole number of the data", -largest_msh_int, largest_msh_int);
    if (static_cast<std::size_t>(i) < first.size()) {
      first[static_cast<std::size_t>(i)] = value;
    }
  }
  if (integers < 3 || first[1] < 1 || first[2] < 0) {
    return false;
  }
  section.components = static_cast<std::size_t>(first[1]);
  section.rows = static_cast<std::size_t>(first[2]);
  if (input.header().binary) {
    text.next_line();
  }
  input.require_room("rows of data", section.rows, 1 + section.components,
                     sizeof(std::int32_t) + section.components * sizeof(double));
  section.begin = input.offset();
  return true;
}

void read_msh_data(MshInput& input, MshRows& rows, const MshDataSection& section, const MshNodes& nodes,
                   const MshElements& elements, FreeNames& names, MeshDocument& document,
                   std::vector<NumberSites>& sites) {
  const std::size_t size = section.of_nodes ? document.point_count() : document.cells.size();
  const std::size_t elements_or_nodes = section.of_nodes ? size : elements.tags.size();
  const std::string things = section.of_nodes ? "node" : "element";
  const std::string which = "The " + things + " data '" + section.name + "'";
  if (section.components > most_msh_components || section.rows < size) {
    document.notes.push_back(which +
                             (section.components > most_msh_components
                                  ? " have " + std::to_string(section.components) + " numbers a row"
                                  : " have values for " + std::to_string(section.rows) + " of " +
                                        std::to_string(elements_or_nodes) + " " + things + "s") +
                             "; they are kept in MSH output only.");
    return;
  }
  static const std::vector<std::int32_t> same;
  MshDataReader reader(input, rows, section, section.of_nodes ? nodes.tags : elements.tags,
                       section.of_nodes ? same : elements.cells, size);
  reader.read();
  if (reader.named < size) {
    document.notes.push_back(which + " have values for " + std::to_string(reader.named) + " of " +
                             std::to_string(size) + " " + things + "s; they are kept in MSH output only.");
    return;
  }
  const std::string name = names.claim(section.name.empty() ? "data" : section.name);
  DataArray array = make_data_array(name, section.components, std::move(reader.values));
  if (!section.of_nodes) {
    document.cell_arrays.push_back(std::move(array));
    return;
  }
  document.point_arrays.push_back(std::move(array));
  // A row for each node; else some stand there twice, or are of none.
  if (section.rows != size) {
    return;
  }
  NumberSites& list = sites.emplace_back();
  list.encoding = input.header().encoding();
  list.columns.clear();
  for (std::size_t i = 0; i < section.components; ++i) {
    list.columns.push_back({name, static_cast<std::uint8_t>(i)});
  }
  list.offsets = std::move(reader.offsets);
  bool in_order = true;
  for (std::size_t row = 0; row < size; ++row) {
    in_order = in_order && reader.of_rows[row] == static_cast<std::int32_t>(row);
  }
  if (!in_order) {
    list.vertices = std::move(reader.of_rows);
  }
}

}  // namespace trismooth
