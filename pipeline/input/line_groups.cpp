// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/line_groups.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "trismooth/mesh_io/document/point_labels.h"

namespace trismooth {

namespace {

constexpr int line_dimension = 1;

bool is_integer(ScalarType type) {
  return type != ScalarType::float32 && type != ScalarType::float64;
}

}  // namespace

std::vector<FileLineGroup> find_line_groups(const MeshDocument& document) {
  std::vector<FileLineGroup> groups;
  const CellList& cells = document.cells;
  for (const DataArray& array : document.cell_arrays) {
    if (array.description == nullptr || array.components != 1 || !is_integer(array.type)) {
      continue;
    }
    std::unordered_map<std::int64_t, std::size_t> group_of;
    for (const ValueName& name : array.description->value_names) {
      if (name.dimension == line_dimension && group_of.emplace(name.value, groups.size()).second) {
        groups.push_back({name.name, 0});
      }
    }
    if (group_of.empty()) {
      continue;
    }
    std::vector<std::pair<std::size_t, std::int32_t>> uses;  // of a vertex by a group
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cell_type::dimension(cells.types[c]) != line_dimension) {
        continue;
      }
      if (const auto found = group_of.find(point_label(array, c)); found != group_of.end()) {
        for (const std::int32_t v : cells[c]) {
          uses.emplace_back(found->second, v);
        }
      }
    }
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    for (const auto& [group, vertex] : uses) {
      ++groups[group].vertices;
    }
  }
  return groups;
}

}  // namespace trismooth
