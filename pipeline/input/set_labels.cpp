// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/set_labels.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include "trismooth/base/text/digits.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/base/text/plain_name.h"
#include "trismooth/base/text/suggestion.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/pipeline/input/value_numbers.h"

namespace trismooth {

namespace {

constexpr std::size_t most_listed = 20;  ///< names or values in a message

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// The one spelling of a number, "7" of "07" and "7.0"; what is no number as it is.
std::string spelled(std::string_view text) {
  if (const auto whole = number_in<std::int64_t>(text)) {
    return std::to_string(*whole);
  }
  if (const auto whole = number_in<std::uint64_t>(text)) {
    return std::to_string(*whole);
  }
  const auto number = number_in<double>(text);
  return number && *number == 0 ? "0" : number ? plain_text(*number) : std::string(text);
}

ValueNumbers values_in(const DataArray& array) {
  std::vector<std::int32_t> rows(array.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return number_values(array, rows);
}

std::string spelled_value(const DataArray& array, std::int32_t row) {
  return spelled(value_text(array, static_cast<std::size_t>(row)));
}

/// Calls `visit` with the rows of the label among arrays of one kind.
template <class Visit>
void visit_rows(std::span<const DataArray> arrays, const SetLabel& label, const Visit& visit) {
  const DataArray* const array = find_array(arrays, label.array);
  if (array == nullptr || array->components != 1) {
    return;
  }
  const ValueNumbers values = values_in(*array);
  const auto found =
      std::ranges::find(values.example, label.value, [&](std::int32_t row) { return spelled_value(*array, row); });
  for (std::size_t row = 0; found != values.example.end() && row < values.of_item.size(); ++row) {
    if (values.of_item[row] == found - values.example.begin()) {
      visit(row);
    }
  }
}

/// What the file calls values of an array of cells.
std::span<const ValueName> names_in(const MeshDocument& document, std::string_view array) {
  const DataArray* const found = find_array(document.cell_arrays, array);
  return found == nullptr || found->description == nullptr ? std::span<const ValueName>()
                                                           : found->description->value_names;
}

/// Numbers ascending, then other texts, each once.
void put_in_order(std::vector<std::string>& values) {
  const auto key = [](const std::string& text) {
    return std::tuple(number_in<double>(text).value_or(std::numeric_limits<double>::infinity()), text);
  };
  std::ranges::sort(values, {}, key);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::string first_of(std::span<const std::string> texts) {
  if (texts.empty()) {
    return "none";
  }
  const auto listed = texts.first(std::min(texts.size(), most_listed));
  return list_text(listed) + (listed.size() < texts.size() ? " and more" : "");
}

}  // namespace

void add_label_array(std::vector<std::string>& names, const std::string& array, std::uint64_t components) {
  if (components == 1 && !is_annotation(array) && std::ranges::find(names, array) == names.end()) {
    names.push_back(array);
  }
}

std::vector<std::string> label_arrays(const MeshDocument& document) {
  std::vector<std::string> names;
  for (const auto& arrays : {std::span(document.point_arrays), std::span(document.cell_arrays)}) {
    for (const DataArray& array : arrays) {
      add_label_array(names, array.name, array.components);
    }
  }
  for (const LabelArray& array : document.cell_labels) {
    add_label_array(names, array.name, 1);
  }
  return names;
}

std::optional<SetLabel> find_label(std::span<const std::string> arrays, std::string_view name) {
  const std::size_t sign = name.rfind('=');
  if (sign == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view wanted = name.substr(0, sign);
  auto array = std::ranges::find(arrays, wanted);
  if (const std::string plain = plain_name(wanted); array == arrays.end() && !plain.empty()) {
    array = std::ranges::find(arrays, plain, [](const std::string& other) { return plain_name(other); });
  }
  return array == arrays.end() ? std::nullopt : std::optional(SetLabel{*array, spelled(name.substr(sign + 1))});
}

std::vector<std::uint8_t> points_of_label(const MeshDocument& document, const SetLabel& label,
                                          std::span<const std::uint8_t> copies) {
  std::vector<std::uint8_t> flags(document.point_count(), 0);
  visit_rows(document.point_arrays, label, [&](std::size_t point) { flags[point] = 1; });
  const auto add_cell = [&](std::size_t cell) {
    if (copies.empty() || copies[cell] == 0) {
      for (const std::int32_t point : document.cells[cell]) {
        flags[static_cast<std::size_t>(point)] = 1;
      }
    }
  };
  visit_rows(document.cell_arrays, label, add_cell);
  for (const ValueName& name : names_in(document, label.array)) {
    if (spelled(name.name) == label.value) {
      visit_rows(document.cell_arrays, {label.array, std::to_string(name.value)}, [&](std::size_t cell) {
        if (cell_type::dimension(document.cells.types[cell]) == name.dimension) {
          add_cell(cell);
        }
      });
    }
  }
  for (const LabelArray& array : document.cell_labels) {
    for (std::size_t cell = 0; array.name == label.array && cell < array.of_row.size(); ++cell) {
      if (array.labels[static_cast<std::size_t>(array.of_row[cell])] == label.value) {
        add_cell(cell);
      }
    }
  }
  const CellGroups groups = document.cell_sets.empty() ? CellGroups() : find_cell_groups(document);
  for (const CellGroup& group : groups.groups) {
    const bool is_alike = std::to_string(group.number) == label.value || spelled(group.name) == label.value;
    const std::string& array = groups.arrays.of_dimension.at(static_cast<std::size_t>(group.dimension));
    if (array == label.array && is_alike && group.whole_set >= 0) {
      for (const std::int32_t cell : document.cell_sets[static_cast<std::size_t>(group.whole_set)].members) {
        add_cell(static_cast<std::size_t>(cell));
      }
    }
  }
  return flags;
}

std::vector<std::string> label_values(const MeshDocument& document, std::string_view array) {
  std::vector<std::string> texts;
  for (const auto& arrays : {std::span(document.point_arrays), std::span(document.cell_arrays)}) {
    if (const DataArray* const found = find_array(arrays, array); found != nullptr && found->components == 1) {
      // (Ascending.)
      const std::vector<std::int32_t> rows = values_in(*found).example;
      for (std::size_t i = 0; i < std::min(rows.size(), most_listed + 1); ++i) {
        texts.push_back(spelled_value(*found, rows[i]));
      }
    }
  }
  for (const LabelArray& found : document.cell_labels) {
    if (found.name == array) {
      texts.insert(texts.end(), found.labels.begin(), found.labels.end());
    }
  }
  std::ranges::transform(names_in(document, array), std::back_inserter(texts), &ValueName::name);
  put_in_order(texts);
  texts.resize(std::min(texts.size(), most_listed + 1));
  return texts;
}

std::invalid_argument complain_of_value(const SetLabel& label, std::vector<std::string> values) {
  put_in_order(values);
  return std::invalid_argument("no point or cell of the file has '" + label.name() +
                               "', whose points are to be held; '" + label.array + "' has: " + first_of(values));
}

std::vector<std::string> names_of_values(const MeshDocument& document) {
  std::vector<std::string> names;
  for (const DataArray& array : document.cell_arrays) {
    std::ranges::transform(names_in(document, array.name), std::back_inserter(names), &ValueName::name);
  }
  for (const LabelArray& array : document.cell_labels) {
    std::ranges::copy_if(array.labels, std::back_inserter(names),
                         [](const std::string& label) { return !number_in<double>(label); });
  }
  if (!document.cell_sets.empty()) {
    std::ranges::transform(find_cell_groups(document).groups, std::back_inserter(names), &CellGroup::name);
  }
  std::erase(names, "");
  put_in_order(names);
  return names;
}

bool is_bare_label(std::string_view name, std::span<const SetLabel> meant) {
  return meant.size() == 1 && !number_in<double>(name);
}

std::invalid_argument complain_of_set(const std::string& name, std::span<const std::string> names,
                                      std::span<const std::string> arrays, std::span<const SetLabel> meant) {
  const std::string there_is_none = "the file has no point set '" + name + "' to hold";
  if (!meant.empty()) {
    const auto quoted_name = [](const SetLabel& label) { return "'" + label.name() + "'"; };
    return std::invalid_argument(there_is_none + "; did you mean " + list_text(meant, quoted_name, " or ") + "?");
  }
  const std::string labels =
      arrays.empty() ? "" : "; points are named as ARRAY=NUMBER, or ARRAY=NAME, by its arrays: " + first_of(arrays);
  return std::invalid_argument(there_is_none + did_you_mean(name, names) + "; it has: " + first_of(names) + labels);
}

}  // namespace trismooth
