// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_groups.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "trismooth/mesh_io/document/region_names.h"

namespace trismooth {

namespace {

bool is_whole(ScalarType type) {
  return type != ScalarType::float32 && type != ScalarType::float64;
}

bool has_names(const DataArray& array) {
  return array.description != nullptr && !array.description->value_names.empty();
}

const DataArray* group_array(const MeshDocument& document) {
  const auto usable = [](const DataArray& array) { return array.components == 1 && is_whole(array.type); };
  for (const DataArray& array : document.cell_arrays) {
    if (usable(array) && has_names(array)) {
      return &array;
    }
  }
  for (const DataArray& array : document.cell_arrays) {
    if (usable(array) && is_region_name(array.name)) {
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

std::vector<std::int64_t> values_of(const DataArray& array) {
  return visit_scalar_type(array.type, [&array](auto zero) {
    const auto values = array.as<decltype(zero)>();
    std::vector<std::int64_t> whole(values.size());
    std::ranges::transform(values, whole.begin(), [](auto value) { return static_cast<std::int64_t>(value); });
    return whole;
  });
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

CellGroups find_cell_groups(const MeshDocument& document) {
  const DataArray* const array = group_array(document);
  if (array == nullptr) {
    return {};
  }
  const std::vector<std::int64_t> values = values_of(*array);
  const CellList& cells = document.cells;
  std::map<GroupKey, std::int32_t> places;
  // Cells of one group stand together, mostly.
  GroupKey last{-1, 0};
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (const GroupKey key{cell_type::dimension(cells.types[cell]), values[cell]}; key != last) {
      places.emplace(last = key, 0);
    }
  }
  const std::map<GroupKey, std::string> names = names_of(*array);
  CellGroups found;
  found.array = array->name;
  for (auto& [key, place] : places) {
    const auto& [dimension, value] = key;
    const auto name = names.find(key);
    CellGroup group{dimension, value, name == names.end() ? std::string() : name->second};
    const auto first = places.lower_bound({dimension, std::numeric_limits<std::int64_t>::min()});
    const bool alone =
        first->first == key && (std::next(first) == places.end() || std::next(first)->first.first != dimension);
    if (value == 0 && group.name.empty() && (has_names(*array) || !alone)) {
      place = -1;
      continue;
    }
    place = static_cast<std::int32_t>(found.groups.size());
    found.groups.push_back(std::move(group));
  }
  found.of_cell.resize(cells.size());
  last = {-1, 0};
  std::int32_t place = -1;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (const GroupKey key{cell_type::dimension(cells.types[cell]), values[cell]}; key != last) {
      place = places.at(last = key);
    }
    found.of_cell[cell] = place;
  }
  find_whole_sets(document, found);
  return found;
}

}  // namespace trismooth
