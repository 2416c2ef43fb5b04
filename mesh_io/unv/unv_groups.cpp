// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/unv/unv_groups.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

/// The places of those ids that there are, ascending, each once.
std::vector<std::int32_t> places_of(const std::vector<std::int64_t>& ids, const PointIds& known) {
  std::vector<std::int32_t> places;
  for (const std::int64_t id : ids) {
    if (const auto place = known.find(id)) {
      places.push_back(*place);
    }
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

bool names_others(const std::vector<std::int64_t>& ids, const PointIds& known) {
  return std::ranges::any_of(ids, [&known](std::int64_t id) { return !known.find(id); });
}

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
std::vector<std::int64_t> values_of_groups(const std::vector<UnvGroup>& groups,
                                           const std::vector<Dimensions>& dimensions) {
  std::set<std::int64_t> numbers{0};
  for (const UnvGroup& group : groups) {
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

/// Gives each cell the value of the smallest group that it is in: a group of all faces is no region beside those of the
/// materials, wherever it stands. The others become sets of cells. `cells` are those of each group.
void add_regions(const std::vector<UnvGroup>& groups, std::vector<std::vector<std::int32_t>> cells,
                 MeshDocument& document) {
  std::vector<Dimensions> dimensions;
  std::vector<std::size_t> by_size;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    dimensions.push_back(dimensions_of(document.cells, cells[i]));
    if (!cells[i].empty()) {
      by_size.push_back(i);
    }
  }
  if (by_size.empty()) {
    return;
  }
  const std::vector<std::int64_t> values = values_of_groups(groups, dimensions);
  std::ranges::sort(by_size, {}, [&cells](std::size_t i) { return std::pair(cells[i].size(), i); });
  std::vector<std::int64_t> of_cell(document.cells.size());
  std::vector<bool> is_whole(groups.size(), true);
  std::vector<Dimensions> named(groups.size(), Dimensions{});
  for (const std::size_t i : by_size) {
    for (const std::int32_t cell : cells[i]) {
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
      if (named[i].at(dimension)) {
        description.value_names.push_back({values[i], static_cast<int>(dimension), groups[i].name});
      }
    }
    if (!is_whole[i]) {
      document.cell_sets.push_back({groups[i].name, std::move(cells[i])});
    }
  }
  DataArray array = make_data_array("unv:group", 1, std::move(of_cell));
  array.description = std::make_shared<const ArrayDescription>(std::move(description));
  document.cell_arrays.push_back(std::move(array));
}

}  // namespace

void add_unv_groups(std::vector<UnvGroup> groups, const PointIds& nodes, const PointIds& elements,
                    MeshDocument& document) {
  std::vector<std::vector<std::int32_t>> cells;
  std::string with_others;
  for (UnvGroup& group : groups) {
    if (group.name.empty()) {
      group.name = "group " + std::to_string(group.number);
    }
    if (names_others(group.nodes, nodes) || names_others(group.elements, elements)) {
      add_to_list(with_others, group.name);
    }
    if (std::vector<std::int32_t> points = places_of(group.nodes, nodes); !points.empty()) {
      document.point_sets.push_back({group.name, std::move(points)});
    }
    cells.push_back(places_of(group.elements, elements));
  }
  add_regions(groups, std::move(cells), document);
  if (!with_others.empty()) {
    document.notes.push_back("Groups name nodes or elements that are not in the file: " + with_others + ".");
  }
}

}  // namespace trismooth
