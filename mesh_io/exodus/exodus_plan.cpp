// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/exodus/exodus_plan.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

namespace {

bool is_line(std::uint8_t type) {
  return type == cell_type::line || type == cell_type::quadratic_edge;
}

/// Ids from 1 on, each once.
class FreeIds {
 public:
  std::int64_t claim(std::int64_t wanted) {
    constexpr std::int64_t most = 2147483647;
    if (wanted >= 1 && wanted <= most && taken_.insert(wanted).second) {
      return wanted;
    }
    while (!taken_.insert(next_).second) {
      ++next_;
    }
    return next_;
  }

 private:
  std::set<std::int64_t> taken_;
  std::int64_t next_ = 1;
};

/// A side of a face.
struct FaceSide {
  std::int32_t cell = -1;
  std::int32_t side = -1;
};

class Planner {
 public:
  explicit Planner(const MeshDocument& document)
      : document_(document), cells_(document.cells), groups_(find_cell_groups(document)) {}

  ExodusPlan plan() {
    plan_.group_arrays = groups_.arrays;
    find_lines_of_sets();
    find_sides();
    make_blocks();
    add_side_sets();
    add_cell_sets();
    add_node_sets();
    return std::move(plan_);
  }

 private:
  std::int32_t group_of(std::size_t cell) const { return groups_.of_cell.empty() ? -1 : groups_.of_cell[cell]; }

  /// Lines that a group or a set has, and what is looked up of them: their ends, the lower first.
  void find_lines_of_sets() {
    std::vector<bool> is_in_set(cells_.size(), false);
    for (const NamedSet& set : document_.cell_sets) {
      for (const std::int32_t cell : set.members) {
        is_in_set[static_cast<std::size_t>(cell)] = true;
      }
    }
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      if (is_line(cells_.types[cell]) && (is_in_set[cell] || group_of(cell) >= 0)) {
        lines_.emplace_back(ends_of(cells_[cell][0], cells_[cell][1]), static_cast<std::int32_t>(cell));
      }
    }
    std::ranges::sort(lines_);
    side_of_.resize(lines_.size());
  }

  static std::array<std::int32_t, 2> ends_of(std::int32_t a, std::int32_t b) {
    return {std::min(a, b), std::max(a, b)};
  }

  /// The first face that has each line as a side.
  void find_sides() {
    if (lines_.empty()) {
      return;
    }
    std::vector<bool> is_end(document_.point_count(), false);
    for (const auto& [ends, cell] : lines_) {
      is_end[static_cast<std::size_t>(ends[0])] = true;
      is_end[static_cast<std::size_t>(ends[1])] = true;
    }
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const auto vertices = cells_[cell];
      const std::size_t corners = exodus_corners(cells_.types[cell], vertices.size());
      for (std::size_t side = 0; side < corners; ++side) {
        const std::int32_t a = vertices[side];
        const std::int32_t b = vertices[(side + 1) % corners];
        if (!is_end[static_cast<std::size_t>(a)] || !is_end[static_cast<std::size_t>(b)]) {
          continue;
        }
        const auto ends = ends_of(a, b);
        for (auto line = std::ranges::lower_bound(lines_, ends, {}, [](const auto& known) { return known.first; });
             line != lines_.end() && line->first == ends; ++line) {
          FaceSide& found = side_of_[static_cast<std::size_t>(line - lines_.begin())];
          if (found.cell < 0) {
            found = {static_cast<std::int32_t>(cell), static_cast<std::int32_t>(side)};
          }
        }
      }
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (side_of_[i].cell >= 0) {
        sides_.emplace(lines_[i].second, side_of_[i]);
      }
    }
    plan_.lines_as_sides = sides_.size();
  }

  void make_blocks() {
    plan_.element_of.assign(cells_.size(), -1);
    // By type in the order of the table (faces, lines, solids), then by group.
    std::map<std::pair<std::uint8_t, std::int32_t>, std::size_t> places;
    std::pair<std::uint8_t, std::int32_t> last{0, 0};
    std::size_t place = 0;
    std::vector<ExodusPlanBlock> blocks;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const std::uint8_t type = cells_.types[cell];
      const bool is_polygon = type == cell_type::polygon;
      if ((!is_polygon && exodus_shape_of_cell(type).nodes != cells_[cell].size()) ||
          (is_line(type) && sides_.contains(static_cast<std::int32_t>(cell)))) {
        continue;
      }
      if (const std::pair key{type, group_of(cell)}; blocks.empty() || key != last) {
        const auto [found, is_new] = places.try_emplace(last = key, blocks.size());
        place = found->second;
        if (is_new) {
          blocks.emplace_back().shape = is_polygon ? ExodusShape{} : exodus_shape_of_cell(type);
        }
      }
      blocks[place].cells.push_back(static_cast<std::int32_t>(cell));
    }
    name_blocks(places, blocks);
    for (const auto& [key, block] : places) {
      plan_.blocks.push_back(std::move(blocks[block]));
    }
    std::ranges::sort(plan_.blocks, {}, [](const ExodusPlanBlock& block) {
      return std::pair(block.shape.nodes == 0 ? 3 : cell_type::dimension(block.shape.type) == 2 ? 0 : 1, block.id);
    });
    std::int32_t before = -1;
    for (const ExodusPlanBlock& block : plan_.blocks) {
      for (const std::int32_t cell : block.cells) {
        plan_.element_of[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(plan_.elements++);
        plan_.keeps_order = plan_.keeps_order && cell > before;
        before = cell;
      }
    }
  }

  /// Groups of faces keep their numbers before all others, and the first block of each before others of it.
  void name_blocks(const std::map<std::pair<std::uint8_t, std::int32_t>, std::size_t>& places,
                   std::vector<ExodusPlanBlock>& blocks) {
    std::vector<std::tuple<bool, int, std::int64_t, std::uint8_t, std::int32_t, std::size_t>> order;
    std::map<std::pair<int, std::int32_t>, std::vector<std::size_t>> of_groups;
    for (const auto& [key, block] : places) {
      const int dimension = cell_type::dimension(key.first);
      const std::int64_t number = key.second < 0 ? 0 : groups_.groups[static_cast<std::size_t>(key.second)].number;
      std::vector<std::size_t>& of_group = of_groups[{dimension, key.second}];
      of_group.push_back(block);
      order.emplace_back(of_group.size() > 1,
                         key.second < 0   ? 4
                         : dimension == 2 ? 0
                                          : 1 + dimension,
                         number, key.first, key.second, block);
    }
    std::ranges::sort(order);
    FreeIds ids;
    FreeNames names;
    for (const auto& [is_further, rank, number, type, group, block] : order) {
      const std::vector<std::size_t>& of_group = of_groups.at({cell_type::dimension(type), group});
      blocks[block].id = ids.claim(is_further ? 0 : number);
      if (group < 0) {
        continue;
      }
      blocks[block].region = blocks[of_group.front()].id;
      const std::string& name = groups_.groups[static_cast<std::size_t>(group)].name;
      if (!is_further) {
        note_number(number, name, blocks[block].id, plan_.renumbered_blocks);
      }
      if (!name.empty()) {
        const std::string wanted =
            is_further ? name + "_" + lower_case(blocks[block].shape.nodes == 0 ? "nsided" : blocks[block].shape.name)
                       : name;
        blocks[block].name = names.claim(wanted);
        if (blocks[block].name != wanted) {
          plan_.renamed.push_back(wanted + " (as " + blocks[block].name + ")");
        }
      }
    }
    for (const auto& [key, of_group] : of_groups) {
      const auto& [dimension, group] = key;
      plan_.has_regions =
          plan_.has_regions || (dimension == 2 && of_group.size() > 1) || (group < 0 && order.size() > 1);
      if (group >= 0 && of_group.size() > 1) {
        const CellGroup& split = groups_.groups[static_cast<std::size_t>(group)];
        plan_.split.push_back(
            (split.name.empty() ? std::to_string(split.number) : split.name) + " (" +
            list_text(of_group, [&blocks](std::size_t block) { return std::to_string(blocks[block].id); }) + ")");
      }
    }
  }

  static void note_number(std::int64_t number, const std::string& name, std::int64_t id,
                          std::vector<std::string>& renumbered) {
    if (number != id) {
      renumbered.push_back(std::to_string(number) + (name.empty() ? "" : " (" + name + ")") + " to " +
                           std::to_string(id));
    }
  }

  void add_side(ExodusPlanSet& set, std::int32_t line) const {
    if (const auto found = sides_.find(line); found != sides_.end()) {
      set.members.push_back(plan_.element_of[static_cast<std::size_t>(found->second.cell)]);
      set.sides.push_back(found->second.side);
    }
  }

  void add_side_sets() {
    std::vector<ExodusPlanSet> sets(groups_.groups.size());
    for (std::size_t cell = 0; cell < groups_.of_cell.size(); ++cell) {
      if (const std::int32_t group = groups_.of_cell[cell];
          group >= 0 && is_line(cells_.types[cell]) && groups_.groups[static_cast<std::size_t>(group)].whole_set < 0) {
        add_side(sets[static_cast<std::size_t>(group)], static_cast<std::int32_t>(cell));
      }
    }
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const CellGroup& group = groups_.groups[i];
      if (group.dimension == 1 && group.whole_set >= 0) {
        for (const std::int32_t cell : document_.cell_sets[static_cast<std::size_t>(group.whole_set)].members) {
          add_side(sets[i], cell);
        }
      }
      if (!sets[i].members.empty() || (group.is_empty && group.dimension == 1)) {
        sets[i].id = side_ids_.claim(group.number);
        sets[i].name = group.name;
        note_number(group.number, group.name, sets[i].id, plan_.renumbered_sets);
        plan_.side_sets.push_back(std::move(sets[i]));
      }
    }
  }

  void add_cell_sets() {
    std::vector<bool> is_side_set(document_.cell_sets.size());  // of a group
    for (const CellGroup& group : groups_.groups) {
      if (group.dimension == 1 && group.whole_set >= 0) {
        is_side_set[static_cast<std::size_t>(group.whole_set)] = true;
      }
    }
    FreeIds element_ids;
    for (const CellGroup& group : groups_.groups) {
      if (group.is_empty && group.dimension != 1) {
        plan_.element_sets.push_back({element_ids.claim(0), group.name, {}, {}});
      }
    }
    for (std::size_t i = 0; i < document_.cell_sets.size(); ++i) {
      const NamedSet& set = document_.cell_sets[i];
      ExodusPlanSet sides{.name = set.name, .members = {}, .sides = {}};
      ExodusPlanSet elements{.name = set.name, .members = {}, .sides = {}};
      for (const std::int32_t cell : set.members) {
        if (const std::int32_t element = plan_.element_of[static_cast<std::size_t>(cell)]; element >= 0) {
          elements.members.push_back(element);
        } else {
          add_side(sides, cell);
        }
      }
      if (!sides.members.empty() && !is_side_set[i]) {
        sides.id = side_ids_.claim(0);
        plan_.side_sets.push_back(std::move(sides));
      }
      if (!elements.members.empty() || set.members.empty()) {
        elements.id = element_ids.claim(0);
        plan_.element_sets.push_back(std::move(elements));
      }
    }
  }

  void add_node_sets() {
    FreeIds ids;
    for (const NamedSet& set : document_.point_sets) {
      plan_.node_sets.push_back({ids.claim(0), set.name, set.members, {}});
    }
  }

  const MeshDocument& document_;
  const CellList& cells_;
  CellGroups groups_;
  ExodusPlan plan_;
  std::vector<std::pair<std::array<std::int32_t, 2>, std::int32_t>> lines_;  ///< ends and cell
  std::vector<FaceSide> side_of_;                                            ///< of these
  std::map<std::int32_t, FaceSide> sides_;  ///< of lines that are sides, by their cells
  FreeIds side_ids_;
};

}  // namespace

ExodusPlan make_exodus_plan(const MeshDocument& document) {
  return Planner(document).plan();
}

}  // namespace trismooth
