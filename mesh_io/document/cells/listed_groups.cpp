// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/listed_groups.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

namespace trismooth {

namespace {

using Dimensions = std::array<bool, 4>;

std::size_t dimension_of(const CellList& cells, std::int32_t cell) {
  return static_cast<std::size_t>(cell_type::dimension(cells.types[static_cast<std::size_t>(cell)]));
}

Dimensions dimensions_of(const CellList& cells, const std::vector<std::int32_t>& members) {
  Dimensions dimensions{};
  for (const std::int32_t cell : members) {
    dimensions.at(dimension_of(cells, cell)) = true;
  }
  return dimensions;
}

/// The value that stands for each group: its number, where no group before it has that for cells of such a dimension
/// (lines and faces may be numbered by themselves), else one that no group has.
std::vector<std::int64_t> values_of_groups(const std::vector<ListedGroup>& groups,
                                           const std::vector<Dimensions>& dimensions) {
  std::set<std::int64_t> numbers{0};
  for (const ListedGroup& group : groups) {
    numbers.insert(group.number);
  }
  std::array<std::set<std::int64_t>, 4> taken;
  std::vector<std::int64_t> values;
  std::int64_t next = 1;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::int64_t value = groups[i].number;
    bool is_free = value != 0;
    for (std::size_t dimension = 0; dimension < taken.size(); ++dimension) {
      is_free = is_free && !(dimensions[i].at(dimension) && taken.at(dimension).contains(value));
    }
    if (!is_free) {
      while (!numbers.insert(next).second) {
        ++next;
      }
      value = next;
    }
    for (std::size_t dimension = 0; dimension < taken.size(); ++dimension) {
      if (dimensions[i].at(dimension)) {
        taken.at(dimension).insert(value);
      }
    }
    values.push_back(value);
  }
  return values;
}

}  // namespace

bool add_listed_groups(const std::string& array, std::vector<ListedGroup> groups, MeshDocument& document) {
  std::vector<Dimensions> dimensions;
  std::vector<std::size_t> by_size;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    dimensions.push_back(dimensions_of(document.cells, groups[i].cells));
    if (!groups[i].cells.empty()) {
      by_size.push_back(i);
    } else {
      document.cell_sets.push_back({groups[i].name, {}});
    }
  }
  if (by_size.empty()) {
    return false;
  }
  const std::vector<std::int64_t> values = values_of_groups(groups, dimensions);
  std::ranges::sort(by_size, {}, [&groups](std::size_t i) { return std::pair(groups[i].cells.size(), i); });
  std::vector<std::int64_t> of_cell(document.cells.size());
  std::vector<bool> is_whole(groups.size(), true);
  std::vector<Dimensions> named(groups.size(), Dimensions{});
  for (const std::size_t i : by_size) {
    for (const std::int32_t cell : groups[i].cells) {
      std::int64_t& value = of_cell[static_cast<std::size_t>(cell)];
      if (value == 0) {
        value = values[i];
        named[i].at(dimension_of(document.cells, cell)) = true;
      } else {
        is_whole[i] = false;
      }
    }
  }
  ArrayDescription description;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (std::size_t dimension = 0; dimension < named[i].size(); ++dimension) {
      if (named[i].at(dimension) && !groups[i].name.empty()) {
        description.value_names.push_back({values[i], static_cast<int>(dimension), groups[i].name});
      }
    }
    if (!is_whole[i]) {
      document.cell_sets.push_back({std::move(groups[i].name), std::move(groups[i].cells)});
    }
  }
  DataArray of_cells = make_data_array(array, 1, std::move(of_cell));
  if (!description.empty()) {
    of_cells.description = std::make_shared<const ArrayDescription>(std::move(description));
  }
  document.cell_arrays.push_back(std::move(of_cells));
  return true;
}

}  // namespace trismooth
