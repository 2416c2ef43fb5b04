// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_groups.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/region_names.h"

namespace trismooth {

namespace {

bool is_whole(ScalarType type) {
  return type != ScalarType::float32 && type != ScalarType::float64;
}

bool has_names(const DataArray& array) {
  return array.description != nullptr && !array.description->value_names.empty();
}

bool is_usable(const DataArray& array) {
  return array.components == 1 && is_whole(array.type);
}

const DataArray* group_array(const MeshDocument& document) {
  for (const DataArray& array : document.cell_arrays) {
    if (is_usable(array) && has_names(array)) {
      return &array;
    }
  }
  for (const DataArray& array : document.cell_arrays) {
    if (is_usable(array) && is_region_name(array.name)) {
      return &array;
    }
  }
  return nullptr;
}

using GroupKey = std::pair<int, std::int64_t>;  // dimension and value

/// The names of values: the first of each.
std::map<GroupKey, std::string> names_of(const DataArray& array) {
  std::map<GroupKey, std::string> names;
  if (array.description != nullptr) {
    for (const ValueName& name : array.description->value_names) {
      names.try_emplace({name.dimension, name.value}, name.name);
    }
  }
  return names;
}

/// The dimensions of the cells at which an array has another value than 0.
std::array<bool, 4> dimensions_of(const DataArray& array, const CellList& cells) {
  return visit_scalar_type(array.type, [&](auto zero) {
    const auto values = array.as<decltype(zero)>();
    std::array<bool, 4> found{};
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      if (values[cell] != zero) {
        found.at(static_cast<std::size_t>(cell_type::dimension(cells.types[cell]))) = true;
      }
    }
    return found;
  });
}

using ArraysOfDimensions = std::array<const DataArray*, 4>;

/// The array of groups, and those that tag the sides or points of faces where it does not.
ArraysOfDimensions group_arrays(const MeshDocument& document) {
  const CellList& cells = document.cells;
  const DataArray* const all = group_array(document);
  ArraysOfDimensions arrays{all, all, all, all};
  std::array<bool, 4> has_cells{};
  for (const std::uint8_t type : cells.types) {
    has_cells.at(static_cast<std::size_t>(cell_type::dimension(type))) = true;
  }
  if (!has_cells[2] || (!has_cells[0] && !has_cells[1])) {
    return arrays;
  }
  std::array<bool, 4> is_tagged = all == nullptr ? std::array<bool, 4>{} : dimensions_of(*all, cells);
  for (const DataArray& array : document.cell_arrays) {
    if (&array == all || !is_usable(array) || is_bookkeeping_name(array.name)) {
      continue;
    }
    const std::array<bool, 4> has = dimensions_of(array, cells);
    for (std::size_t dimension = 0; dimension < 2; ++dimension) {
      if (!is_tagged.at(dimension) && has.at(dimension) && std::ranges::count(has, true) == 1) {
        arrays.at(dimension) = &array;
        is_tagged.at(dimension) = true;
      }
    }
  }
  return arrays;
}

std::vector<std::int64_t> values_of(const DataArray& array) {
  return visit_scalar_type(array.type, [&array](auto zero) {
    const auto values = array.as<decltype(zero)>();
    std::vector<std::int64_t> whole(values.size());
    std::ranges::transform(values, whole.begin(), [](auto value) { return static_cast<std::int64_t>(value); });
    return whole;
  });
}

/// Adds the groups that an array has of cells of that dimension, behind those that are found. `sets`: the names of sets
/// of cells that have any.
void add_groups(const DataArray& array, int dimension, bool are_named, const CellList& cells,
                const std::set<std::string_view>& sets, CellGroups& found) {
  const std::vector<std::int64_t> values = values_of(array);
  std::map<std::int64_t, std::int32_t> places;
  // Cells of one group stand together, mostly.
  std::optional<std::int64_t> last;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cell_type::dimension(cells.types[cell]) == dimension && values[cell] != last) {
      places.emplace(*(last = values[cell]), 0);
    }
  }
  const std::map<GroupKey, std::string> names = names_of(array);
  constexpr std::int32_t without_cells = 1;
  for (const auto& [key, name] : names) {
    if (key.first == dimension && !name.empty() && !sets.contains(name)) {
      places.try_emplace(key.second, without_cells);
    }
  }
  for (auto& [value, place] : places) {
    const auto name = names.find({dimension, value});
    CellGroup group{dimension, value, name == names.end() ? std::string() : name->second};
    group.is_empty = place == without_cells;
    if (value == 0 && group.name.empty() && (has_names(array) || places.size() > 1)) {
      place = -1;
      continue;
    }
    if (are_named && group.name.empty()) {
      group.name = array.name + "_" + std::to_string(value);
    }
    place = static_cast<std::int32_t>(found.groups.size());
    found.groups.push_back(std::move(group));
  }
  last.reset();
  std::int32_t place = -1;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cell_type::dimension(cells.types[cell]) == dimension) {
      if (values[cell] != last) {
        place = places.at(*(last = values[cell]));
      }
      found.of_cell[cell] = place;
    }
  }
}

/// Where groups overlap, an array of one value for a cell has some cells of each, and a set has them all.
void find_whole_sets(const MeshDocument& document, CellGroups& found) {
  if (document.cell_sets.empty() || found.groups.empty()) {
    return;
  }
  std::vector<std::size_t> sizes(found.groups.size());
  for (const std::int32_t group : found.of_cell) {
    sizes[static_cast<std::size_t>(std::max(group, 0))] += group < 0 ? 0 : 1;
  }
  std::vector<std::int32_t> last_set(document.cells.size(), -1);
  for (std::size_t i = 0; i < document.cell_sets.size(); ++i) {
    const NamedSet& set = document.cell_sets[i];
    const auto number = static_cast<std::int32_t>(i);
    std::map<std::int32_t, std::size_t> counts;  // of cells of each group
    for (const std::int32_t member : set.members) {
      const auto cell = static_cast<std::size_t>(member);
      if (found.of_cell[cell] >= 0 && std::exchange(last_set[cell], number) != number) {
        ++counts[found.of_cell[cell]];
      }
    }
    for (const auto& [place, count] : counts) {
      CellGroup& group = found.groups[static_cast<std::size_t>(place)];
      const bool is_alike = set.name == (group.name.empty() ? name_of_unnamed_group(group.number) : group.name);
      if (is_alike && group.whole_set < 0 && count == sizes[static_cast<std::size_t>(place)]) {
        group.whole_set = number;
      }
    }
  }
}

}  // namespace

std::string name_of_unnamed_group(std::int64_t number) {
  return "physical " + std::to_string(number);
}

bool GroupArrays::has(std::string_view name) const {
  return !name.empty() && std::ranges::find(of_dimension, name) != of_dimension.end();
}

std::string GroupArrays::text() const {
  std::vector<std::string> names;
  for (const std::string& name : of_dimension) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) {
      names.push_back(name);
    }
  }
  return list_text(names);
}

CellGroups find_cell_groups(const MeshDocument& document) {
  const ArraysOfDimensions arrays = group_arrays(document);
  const CellList& cells = document.cells;
  CellGroups found;
  found.of_cell.resize(arrays == ArraysOfDimensions{} ? 0 : cells.size(), -1);
  std::set<std::string_view> sets;
  for (const NamedSet& set : document.cell_sets) {
    if (!set.members.empty()) {
      sets.insert(set.name);
    }
  }
  const bool are_several =
      std::ranges::any_of(arrays, [&arrays](const DataArray* array) { return array != nullptr && array != arrays[2]; });
  for (std::size_t dimension = 0; dimension < arrays.size(); ++dimension) {
    if (const DataArray* const array = arrays.at(dimension)) {
      found.arrays.of_dimension.at(dimension) = array->name;
      add_groups(*array, static_cast<int>(dimension), are_several, cells, sets, found);
    }
  }
  find_whole_sets(document, found);
  return found;
}

}  // namespace trismooth
