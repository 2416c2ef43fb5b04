// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_entity_plan.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_fields.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// What makes cells be of one entity.
struct MshEntityKey {
  int dimension;
  std::int32_t geometrical;          ///< 0 where the document does not say
  std::int32_t vertex;               ///< of a point cell; else -1
  std::vector<std::int32_t> groups;  ///< places in the plan, ascending but for the first one

  auto operator<=>(const MshEntityKey&) const = default;
};

class MshEntityPlanner {
 public:
  explicit MshEntityPlanner(const MeshDocument& document)
      : document_(document), cells_(document.cells), groups_(find_cell_groups(document)) {}

  MshEntityPlan plan() {
    find_element_types();
    plan_groups();
    rename_groups();
    find_geometrical();
    find_entities();
    classify_points();
    return std::move(plan_);
  }

 private:
  int dimension_of(std::size_t cell) const { return msh_element_type(plan_.element_types[cell]).dimension; }

  void find_element_types() {
    plan_.element_types.resize(cells_.size());
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const bool goes_on =
          cell > 0 && cells_.types[cell] == cells_.types[cell - 1] && cells_[cell].size() == cells_[cell - 1].size();
      plan_.element_types[cell] =
          goes_on ? plan_.element_types[cell - 1] : msh_number_of(cells_.types[cell], cells_[cell].size());
    }
  }

  void plan_groups() {
    plan_.group_arrays = groups_.arrays;
    const auto can_be_tag = [](std::int64_t number) {
      return number >= 1 && number < std::numeric_limits<std::int32_t>::max();
    };
    for (const CellGroup& group : groups_.groups) {
      if (can_be_tag(group.number)) {
        taken_[group.dimension].insert(static_cast<std::int32_t>(group.number));
      }
    }
    for (const CellGroup& group : groups_.groups) {
      const bool keeps = can_be_tag(group.number);
      plan_.renumbers_groups = plan_.renumbers_groups || !keeps;
      plan_.groups.push_back(
          {group.dimension, keeps ? static_cast<std::int32_t>(group.number) : free_tag(group.dimension), group.name});
      places_of_names_.try_emplace({group.dimension, group.name}, static_cast<std::int32_t>(plan_.groups.size() - 1));
    }
    groups_of_cells_.resize(document_.cell_sets.empty() ? 0 : cells_.size());
    for (const NamedSet& set : document_.cell_sets) {
      if (set.members.empty()) {
        place_of_set(set.name, 2);
      }
      std::array<std::int32_t, 4> places{-1, -1, -1, -1};
      for (const std::int32_t member : set.members) {
        const auto cell = static_cast<std::size_t>(member);
        if (plan_.element_types[cell] == 0) {
          continue;
        }
        const int dimension = dimension_of(cell);
        std::int32_t& place = places[static_cast<std::size_t>(dimension)];
        if (place < 0) {
          place = place_of_set(set.name, dimension);
        }
        groups_of_cells_[cell].push_back(place);
      }
    }
  }

  std::int32_t free_tag(int dimension) {
    std::set<std::int32_t>& tags = taken_[dimension];
    std::int32_t tag = tags.empty() ? 1 : *tags.rbegin() + 1;
    if (tag <= 0 || tag == std::numeric_limits<std::int32_t>::max()) {
      std::int32_t& lowest = lowest_free_[dimension];
      for (lowest = std::max(lowest, 1); tags.contains(lowest); ++lowest) {
      }
      tag = lowest;
    }
    tags.insert(tag);
    return tag;
  }

  /// The group of a dimension's cells that are in no other.
  std::int32_t place_of_rest(int dimension) {
    const auto [rest, is_new] = rests_.try_emplace(dimension, static_cast<std::int32_t>(plan_.groups.size()));
    if (is_new) {
      plan_.groups.push_back({dimension, free_tag(dimension), ""});
      plan_.rests.push_back(plan_.groups.back());
    }
    return rest->second;
  }

  /// Names stand between quotation marks, on one line. Those that are changed stay apart from all others.
  void rename_groups() {
    std::map<int, FreeNames> names;
    const auto is_held = [](const std::string& name) { return plain_msh_name(name) == name; };
    for (const MshPlannedGroup& group : plan_.groups) {
      if (is_held(group.name)) {
        names[group.dimension].take(group.name);
      }
    }
    for (MshPlannedGroup& group : plan_.groups) {
      if (!is_held(group.name)) {
        std::string name = names[group.dimension].claim(plain_msh_name(group.name));
        plan_.renamed.push_back(trismooth::quoted(group.name) + " (as " + name + ")");
        group.name = std::move(name);
      }
    }
  }

  /// A set of a group's name has some of its cells, or all, and others.
  std::int32_t place_of_set(const std::string& name, int dimension) {
    const auto next = static_cast<std::int32_t>(plan_.groups.size());
    if (!name.empty()) {
      if (const auto [named, is_new] = places_of_names_.try_emplace({dimension, name}, next); !is_new) {
        return named->second;
      }
    }
    plan_.groups.push_back({dimension, free_tag(dimension), name});
    return next;
  }

  void find_geometrical() {
    const DataArray* const array = find_array(document_.cell_arrays, "gmsh:geometrical");
    if (array != nullptr && array->components == 1 && array->type == ScalarType::int32) {
      geometrical_ = array->as<std::int32_t>();
    }
  }

  MshEntityKey key_of(std::size_t cell) {
    MshEntityKey key{dimension_of(cell), geometrical_.empty() ? 0 : geometrical_[cell], -1, {}};
    if (key.dimension == 0) {
      key.vertex = cells_[cell].front();
    }
    if (!groups_.of_cell.empty() && groups_.of_cell[cell] >= 0) {
      key.groups.push_back(groups_.of_cell[cell]);
    }
    if (!groups_of_cells_.empty()) {
      std::vector<std::int32_t>& further = groups_of_cells_[cell];
      std::ranges::sort(further);
      const std::int32_t first = key.groups.empty() ? -1 : key.groups.front();
      for (const std::int32_t group : further) {
        if (group != first && (key.groups.empty() || group != key.groups.back())) {
          key.groups.push_back(group);
        }
      }
    }
    if (key.groups.empty() && has_groups_) {
      key.groups.push_back(place_of_rest(key.dimension));
    }
    return key;
  }

  void find_entities() {
    has_groups_ = !plan_.groups.empty();
    std::map<MshEntityKey, std::int32_t> places;
    std::vector<const MshEntityKey*> keys;
    plan_.of_cell.assign(cells_.size(), -1);
    const MshEntityKey* last = nullptr;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (plan_.element_types[cell] == 0) {
        continue;
      }
      MshEntityKey key = key_of(cell);
      if (last == nullptr || key != *last) {
        last = &places.try_emplace(std::move(key), 0).first->first;
      }
      plan_.of_cell[cell] = 0;
      keys.push_back(last);
    }
    plan_.keeps_entities = can_keep_tags(places);
    std::array<std::int32_t, 4> tags{};
    for (auto& [key, place] : places) {
      place = static_cast<std::int32_t>(plan_.entities.size());
      MshPlannedEntity entity{key.dimension,
                              plan_.keeps_entities ? key.geometrical : ++tags[static_cast<std::size_t>(key.dimension)]};
      for (const std::int32_t group : key.groups) {
        entity.physical.push_back(plan_.groups[static_cast<std::size_t>(group)].tag);
      }
      plan_.entities.push_back(std::move(entity));
    }
    std::size_t next = 0;
    for (std::int32_t& of_cell : plan_.of_cell) {
      if (of_cell == 0) {
        of_cell = places.at(*keys[next++]);
      }
    }
  }

  /// The document's numbers of entities can be tags if each is of one entity.
  bool can_keep_tags(const std::map<MshEntityKey, std::int32_t>& places) const {
    const MshEntityKey* before = nullptr;
    for (const auto& [key, place] : places) {
      const bool repeated =
          before != nullptr && before->dimension == key.dimension && before->geometrical == key.geometrical;
      if (key.geometrical < 1 || repeated) {
        return false;
      }
      before = &key;
    }
    return !geometrical_.empty();
  }

  void classify_points() {
    plan_.of_point.assign(document_.point_count(), -1);
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const std::int32_t entity = plan_.of_cell[cell];
      if (entity < 0) {
        continue;
      }
      for (const std::int32_t vertex : cells_[cell]) {
        // Entities ascend by dimension.
        std::int32_t& known = plan_.of_point[static_cast<std::size_t>(vertex)];
        known = known < 0 ? entity : std::min(known, entity);
      }
    }
    if (std::ranges::find(plan_.of_point, -1) == plan_.of_point.end()) {
      return;
    }
    // Points of no cell: on the last entity, or on one of their own where there is none.
    if (plan_.entities.empty()) {
      plan_.entities.push_back({2, 1});
    }
    std::ranges::replace(plan_.of_point, -1, static_cast<std::int32_t>(plan_.entities.size() - 1));
  }

  const MeshDocument& document_;
  const CellList& cells_;
  CellGroups groups_;
  std::vector<std::vector<std::int32_t>> groups_of_cells_;               ///< beside the first one
  std::map<std::pair<int, std::string>, std::int32_t> places_of_names_;  ///< of groups, by dimension and name
  std::map<int, std::set<std::int32_t>> taken_;                          ///< tags of groups, by dimension
  std::map<int, std::int32_t> lowest_free_;                              ///< no tag below is
  std::map<int, std::int32_t> rests_;                                    ///< place_of_rest() by dimension
  bool has_groups_ = false;                                              ///< in the document
  std::span<const std::int32_t> geometrical_;
  MshEntityPlan plan_;
};

}  // namespace

MshEntityPlan plan_msh_entities(const MeshDocument& document) {
  return MshEntityPlanner(document).plan();
}

}  // namespace trismooth
