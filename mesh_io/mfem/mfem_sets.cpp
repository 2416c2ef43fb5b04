// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mfem/mfem_sets.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace trismooth {

namespace {

using Attribute = std::pair<int, std::int64_t>;  // a dimension and a number

/// The cells of each attribute, ascending.
std::map<Attribute, std::vector<std::int32_t>> cells_of_attributes(const CellList& cells,
                                                                   std::span<const std::int32_t> attributes) {
  std::map<Attribute, std::vector<std::int32_t>> found;
  std::vector<std::int32_t>* members = nullptr;
  Attribute last{-1, 0};
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Attribute attribute{cell_type::dimension(cells.types[cell]), attributes[cell]};
    if (members == nullptr || attribute != last) {
      members = &found[last = attribute];
    }
    members->push_back(static_cast<std::int32_t>(cell));
  }
  return found;
}

}  // namespace

void name_mfem_attributes(std::span<const MfemSet> sets, std::span<const std::int32_t> attributes, MemberBudget budget,
                          MeshDocument& document) {
  ArrayDescription description;
  std::map<Attribute, bool> has_name;
  std::map<Attribute, std::vector<std::int32_t>> cells;
  for (const MfemSet& set : sets) {
    if (set.attributes.size() == 1 && !std::exchange(has_name[{set.dimension, set.attributes.front()}], true)) {
      description.value_names.push_back({set.attributes.front(), set.dimension, set.name});
      continue;
    }
    if (cells.empty()) {
      cells = cells_of_attributes(document.cells, attributes);
    }
    NamedSet& named = document.cell_sets.emplace_back(NamedSet{set.name, {}});
    for (const std::int64_t attribute : set.attributes) {
      if (const auto members = cells.find({set.dimension, attribute}); members != cells.end()) {
        budget.spend(members->second.size());
        named.members.insert(named.members.end(), members->second.begin(), members->second.end());
      }
    }
    std::ranges::sort(named.members);
  }
  DataArray array =
      make_data_array("mfem:attribute", 1, std::vector<std::int32_t>(attributes.begin(), attributes.end()));
  if (!description.empty()) {
    array.description = std::make_shared<ArrayDescription>(std::move(description));
  }
  document.cell_arrays.push_back(std::move(array));
}

}  // namespace trismooth
