// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/med/med_families.h"

#include <map>
#include <utility>

#include "trismooth/mesh_io/document/cells/group_lists.h"

namespace trismooth {

namespace {

/// The number of the family of each point or cell, `step`, twice that, and so on; empty where none is in a group. Cells
/// of two dimensions share no family: programs make of each a part of one dimension. Groups without members have a
/// family each.
template <class DimensionOf>
std::vector<std::int64_t> find_families(std::vector<std::vector<std::size_t>>& lists,
                                        const std::vector<std::size_t>& empty, std::int64_t step,
                                        const DimensionOf& dimension_of, std::vector<MedFamily>& families) {
  std::map<std::pair<int, std::vector<std::size_t>>, std::int64_t> known;
  std::vector<std::int64_t> of_each(lists.size());
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (lists[i].empty()) {
      continue;
    }
    const auto [family, is_new] = known.try_emplace({dimension_of(i), std::move(lists[i])},
                                                    step * (static_cast<std::int64_t>(families.size()) + 1));
    if (is_new) {
      families.push_back({family->second, family->first.second});
    }
    of_each[i] = family->second;
  }
  const bool has_members = !families.empty();
  for (const std::size_t group : empty) {
    families.push_back({step * (static_cast<std::int64_t>(families.size()) + 1), {group}});
  }
  return has_members ? of_each : std::vector<std::int64_t>{};
}

}  // namespace

MedFamilies plan_med_families(const MeshDocument& document) {
  GroupLists lists = list_groups(document);
  FittedNames names = fit_names(lists.names, med_group_name_size);
  MedFamilies plan{std::move(names.names), std::move(names.renamed), std::move(lists.arrays), {}, {}, {}, {}};
  plan.cell_families = find_families(
      lists.of_cells, lists.empty_of_cells, -1,
      [&](std::size_t cell) { return cell_type::dimension(document.cells.types[cell]); }, plan.of_cells);
  plan.point_families = find_families(
      lists.of_points, lists.empty_of_points, 1, [](std::size_t /*point*/) { return 0; }, plan.of_points);
  return plan;
}

}  // namespace trismooth
