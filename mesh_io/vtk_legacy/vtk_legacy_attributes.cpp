// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/document/array_limits.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_annotations.h"

namespace trismooth {

namespace {

/// The roles of arrays, by keyword.
constexpr auto roles = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"scalars", "Scalars"},
    {"color_scalars", "Scalars"},
    {"vectors", "Vectors"},
    {"normals", "Normals"},
    {"texture_coordinates", "TCoords"},
    {"tensors", "Tensors"},
    {"tensors6", "Tensors"},
    {"global_ids", "GlobalIds"},
    {"pedigree_ids", "PedigreeIds"},
    {"edge_flags", "EdgeFlag"},
});

/// Where the arrays of a section go.
struct ArrayTarget {
  std::vector<DataArray>& arrays;
  std::vector<std::string>& names;
  std::string_view kind;                           ///< "point", "cell" or "field"
  std::uint64_t rows;                              ///< of every array; of no meaning for fields of the whole mesh
  std::vector<LabelArray>* labels = nullptr;       ///< where arrays of strings go; null: nowhere
  std::vector<VtkLegacyValues>* values = nullptr;  ///< is told where numbers of floating point stand; null: nobody is
};

class ArrayReader {
 public:
  ArrayReader(VtkLegacyInput& input, std::vector<std::string>& notes, ArrayTarget target)
      : input_(input), notes_(notes), target_(target) {}

  /// Where what was read last stands; its own beginning and end are not set.
  const VtkLegacyAnnotations::Attribute& sites() const { return sites_; }

  /// Reads what follows the keyword of an attribute of a section; false for another keyword.
  bool read_attribute(const std::string& keyword) {
    sites_ = {};
    array_begin_ = input_.offset();
    const std::size_t first_array = target_.arrays.size();
    if (keyword == "scalars") {
      read_scalars();
    } else if (keyword == "color_scalars") {
      read_color_scalars();
    } else if (keyword == "lookup_table") {
      skip_lookup_table();
    } else if (keyword == "vectors" || keyword == "normals") {
      read_named(3);
    } else if (keyword == "tensors") {
      read_named(9);
    } else if (keyword == "tensors6") {
      read_named(6);
    } else if (keyword == "global_ids" || keyword == "pedigree_ids" || keyword == "edge_flags") {
      read_named(1);
    } else if (keyword == "texture_coordinates") {
      std::string name = next_array_name();
      const std::uint64_t components = next_component_count();
      read_values(std::move(name), input_.next_type(), components, target_.rows);
    } else if (keyword == "field") {
      read_field();
    } else {
      return false;
    }
    make_active(keyword, first_array);
    return true;
  }

  /// Reads a field, whose arrays have the section's number of rows.
  void read_field() {
    read_field_arrays([&](const std::string& name, std::uint64_t rows) {
      if (rows != target_.rows) {
        input_.fail(std::string(target_.kind) + " array " + trismooth::quoted(name) + " has " + std::to_string(rows) +
                    " rows; expected " + std::to_string(target_.rows));
      }
    });
  }

  /// Reads a field whose arrays have any number of rows; calls `check` with the name and number of rows of each.
  template <class Check>
  void read_field_arrays(Check&& check) {
    input_.next_token("the name of a field");
    const std::uint64_t array_count = input_.next_count("the number of arrays");
    sites_.declared_arrays = array_count;
    sites_.count_begin = input_.token_offset();
    sites_.count_end = input_.offset();
    input_.pass_comment();
    for (std::uint64_t i = 0; i < array_count; ++i) {
      array_begin_ = input_.offset();
      std::string encoded(input_.next_token("the name of an array"));
      if (encoded == "NULL_ARRAY") {
        continue;
      }
      std::string name = decode_vtk_name(encoded);
      const std::uint64_t components = next_component_count();
      const std::uint64_t rows = input_.next_count("the number of rows");
      check(name, rows);
      read_values(std::move(name), input_.next_type(), components, rows);
    }
  }

 private:
  std::string next_array_name() { return input_.next_name("the name of an array"); }

  std::uint64_t next_component_count() {
    const std::uint64_t components = input_.next_count("the number of components");
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    if (components == 0 || components > most) {
      input_.fail("expected the number of components from 1 to " + std::to_string(most) + ", got " +
                  std::to_string(components));
    }
    return components;
  }

  void read_named(std::uint64_t components) {
    std::string name = next_array_name();
    read_values(std::move(name), input_.next_type(), components, target_.rows);
  }

  /// VTK makes the first array of every kind of attribute the active one.
  void make_active(const std::string& keyword, std::size_t first_array) {
    const auto* const role = std::ranges::find(roles, keyword, &std::pair<std::string_view, std::string_view>::first);
    if (role == roles.end() || target_.arrays.size() == first_array ||
        std::ranges::find(roles_given_, role->second) != roles_given_.end()) {
      return;
    }
    roles_given_.push_back(role->second);
    DataArray& array = target_.arrays.back();
    array.description = with_role(array.description.get(), std::string(role->second));
  }

  /// Both the number of components and the lookup table may be left out.
  void read_scalars() {
    std::string name = next_array_name();
    const VtkLegacyType type = input_.next_type();
    std::uint64_t components = 1;
    // In another line, a number is the first value, unless the table follows.
    if (!input_.is_next("lookup_table") && (!input_.at_end_of_line() || input_.is_after_next("lookup_table"))) {
      components = next_component_count();
    }
    if (input_.is_next("lookup_table")) {
      input_.expect_keyword("lookup_table");
      input_.next_token("the name of a lookup table");
    }
    read_values(std::move(name), type, components, target_.rows);
  }

  /// Colours are bytes; ASCII files state them as fractions of 255.
  void read_color_scalars() {
    std::string name = next_array_name();
    const std::uint64_t components = next_component_count();
    const std::uint64_t count = input_.value_count(components, target_.rows, "colours");
    std::vector<std::uint8_t> colors;
    if (input_.is_binary()) {
      colors = input_.read_values<std::uint8_t>(count, "colours", "a colour");
    } else {
      const std::vector<float> values = input_.read_values<float>(count, "colours", "a colour");
      colors.reserve(values.size());
      for (const float value : values) {
        const double fraction = value > 0 ? std::min(1.0, static_cast<double>(value)) : 0;
        colors.push_back(static_cast<std::uint8_t>(std::lround(255.0 * fraction)));
      }
    }
    add(make_data_array(std::move(name), components, std::move(colors)));
    target_.arrays.back().description = input_.read_metadata(components);
  }

  void skip_lookup_table() {
    constexpr std::uint64_t rgba = 4;
    const std::string name = input_.next_name("the name of a lookup table");
    const std::uint64_t size = input_.next_count("the number of colours");
    const std::uint64_t count = input_.value_count(size, rgba, "colours");
    if (input_.is_binary()) {
      input_.read_values<std::uint8_t>(count, "colours", "a colour");
    } else {
      input_.read_values<float>(count, "colours", "a colour");
    }
    notes_.push_back("lookup table " + trismooth::quoted(name) + " is kept in this file only, not in other formats");
  }

  void read_values(std::string name, VtkLegacyType type, std::uint64_t components, std::uint64_t rows) {
    const std::string what = "values of " + std::string(target_.kind) + " array " + trismooth::quoted(name);
    const std::uint64_t count = input_.value_count(components, rows, what);
    const std::size_t first_array = target_.arrays.size();
    switch (type.kind) {
      case VtkLegacyType::Kind::numbers:
        read_numbers(std::move(name), type.scalar, components, count, what);
        break;
      case VtkLegacyType::Kind::bits:
        add(make_data_array(std::move(name), components, input_.read_bits(count, what)));
        break;
      case VtkLegacyType::Kind::strings:
        read_strings(name, components, count, what);
        note_skipped(name, "strings");
        break;
      case VtkLegacyType::Kind::variants:
        input_.skip_variants(count, what);
        note_skipped(name, "variants");
        break;
    }
    if (!input_.is_binary()) {
      input_.pass_comment();
    }
    auto description = input_.read_metadata(components);
    if (target_.arrays.size() > first_array) {
      target_.arrays.back().description = std::move(description);
    }
    sites_.arrays.back().end = input_.offset();
  }

  void read_numbers(std::string name, ScalarType type, std::uint64_t components, std::uint64_t count,
                    const std::string& what) {
    const std::size_t begin = input_.offset();
    add(visit_scalar_type(type, [&](auto zero) {
      return make_data_array(std::move(name), components, input_.read_values<decltype(zero)>(count, what));
    }));
    if (target_.values != nullptr && (type == ScalarType::float32 || type == ScalarType::float64)) {
      const DataArray& array = target_.arrays.back();
      target_.values->push_back(
          {target_.arrays.size() - 1, array, input_.is_binary() ? input_.offset() - array.bytes.size() : begin});
    }
  }

  /// Those of a cell each are kept, since they may name regions.
  void read_strings(const std::string& name, std::uint64_t components, std::uint64_t count, const std::string& what) {
    const std::vector<std::string_view> strings = input_.read_strings(count, what);
    if (target_.labels == nullptr || components != 1) {
      return;
    }
    target_.labels->push_back(make_label_array(name, strings));
    if (!input_.is_binary()) {
      for (std::string& label : target_.labels->back().labels) {
        label = decode_vtk_name(label);
      }
    }
  }

  void add(DataArray array) {
    if (array.bytes.empty() && array.components > most_components_without_rows) {
      input_.fail(std::string(target_.kind) + " array " + trismooth::quoted(array.name) + " has " +
                  std::to_string(array.components) + " components, but no rows");
    }
    add_name(array.name);
    target_.arrays.push_back(std::move(array));
  }

  void note_skipped(const std::string& name, std::string_view content) {
    notes_.push_back(std::string(target_.kind) + " array " + trismooth::quoted(name) + " holds " +
                     std::string(content) + ": it is kept in this file only, not in other formats");
    add_name(name);
  }

  void add_name(const std::string& name) {
    sites_.arrays.push_back({name, array_begin_, input_.offset()});
    if (!is_annotation(name)) {
      target_.names.push_back(name);
    }
  }

  VtkLegacyInput& input_;
  std::vector<std::string>& notes_;
  ArrayTarget target_;
  VtkLegacyAnnotations::Attribute sites_;
  std::size_t array_begin_ = 0;
  std::vector<std::string_view> roles_given_;
};

}  // namespace

void read_vtk_legacy_field(VtkLegacyInput& input, MeshDocument& document) {
  std::vector<std::string> names;
  ArrayReader reader(input, document.notes, {document.field_arrays, names, "field", 0});
  reader.read_field_arrays([](const std::string&, std::uint64_t) {});
}

void read_vtk_legacy_attributes(VtkLegacyInput& input, MeshDocument& document, VtkLegacyLayout& layout) {
  ArrayReader points(
      input, document.notes,
      {document.point_arrays, layout.point_names, "point", document.point_count(), nullptr, &layout.point_values});
  ArrayReader cells(input, document.notes,
                    {document.cell_arrays, layout.cell_names, "cell", document.cells.size(), &document.cell_labels});
  VtkLegacyAnnotations annotations(input.bytes());
  const auto begin_of_next = [&input] {
    input.pass_comments();
    return input.offset();
  };
  for (std::size_t begin = begin_of_next(); !input.at_end(); begin = begin_of_next()) {
    const std::string token(input.next_keyword("a keyword"));
    const std::string keyword = lower_case(token);
    if (keyword == "point_data" || keyword == "cell_data") {
      layout.last_section =
          keyword == "point_data" ? VtkLegacyLayout::Section::point_data : VtkLegacyLayout::Section::cell_data;
      const std::uint64_t expected =
          layout.last_section == VtkLegacyLayout::Section::point_data ? document.point_count() : document.cells.size();
      const std::uint64_t rows = input.next_count("the number of rows");
      if (rows != expected) {
        input.fail(token + " declares " + std::to_string(rows) + " rows; expected " + std::to_string(expected));
      }
      annotations.start_section(layout.last_section, begin);
    } else {
      ArrayReader& section = layout.last_section == VtkLegacyLayout::Section::point_data ? points : cells;
      if (!section.read_attribute(keyword)) {
        input.fail("unknown keyword " + trismooth::quoted(token) + " in the point and cell data");
      }
      VtkLegacyAnnotations::Attribute attribute = section.sites();
      attribute.begin = begin;
      attribute.end = input.offset();
      annotations.add(attribute);
    }
  }
  annotations.finish(layout);
}

}  // namespace trismooth
