// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/empty_groups.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "trismooth/mesh_io/document/cells/cell_groups.h"

namespace trismooth {

namespace {

bool is_empty(const NamedSet& set) {
  return set.members.empty();
}

}  // namespace

std::vector<std::string> names_of_empty_groups(const MeshDocument& document) {
  std::vector<std::string> names;
  for (const CellGroup& group : find_cell_groups(document).groups) {
    if (group.is_empty) {
      names.push_back(group.name);
    }
  }
  for (const auto* const sets : {&document.cell_sets, &document.point_sets}) {
    for (const NamedSet& set : *sets) {
      if (is_empty(set)) {
        names.push_back(set.name);
      }
    }
  }
  return names;
}

MeshDocument without_empty_groups(MeshDocument document) {
  const CellGroups groups = find_cell_groups(document);
  std::set<std::pair<int, std::int64_t>> empty;
  for (const CellGroup& group : groups.groups) {
    if (group.is_empty) {
      empty.emplace(group.dimension, group.number);
    }
  }
  for (DataArray& array : document.cell_arrays) {
    if (!empty.empty() && array.description != nullptr && groups.arrays.has(array.name)) {
      ArrayDescription description = *array.description;
      std::erase_if(description.value_names, [&](const ValueName& name) {
        return groups.arrays.of_dimension.at(static_cast<std::size_t>(name.dimension)) == array.name &&
               empty.contains({name.dimension, name.value});
      });
      array.description = std::make_shared<const ArrayDescription>(std::move(description));
    }
  }
  std::erase_if(document.cell_sets, is_empty);
  std::erase_if(document.point_sets, is_empty);
  return document;
}

}  // namespace trismooth
