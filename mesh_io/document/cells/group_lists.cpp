// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/group_lists.h"

#include <algorithm>
#include <map>
#include <utility>

#include "trismooth/mesh_io/document/free_names.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

class GroupLister {
 public:
  explicit GroupLister(const MeshDocument& document) : document_(document) {}

  GroupLists list() {
    const CellGroups groups = find_cell_groups(document_);
    lists_.arrays = groups.arrays;
    std::vector<std::size_t> places;
    for (const CellGroup& group : groups.groups) {
      places.push_back(place_of(group.name.empty() ? name_of_unnamed_group(group.number) : group.name));
      if (group.is_empty) {
        lists_.empty_of_cells.push_back(places.back());
      }
    }
    lists_.of_cells.resize(document_.cells.size());
    for (std::size_t cell = 0; cell < groups.of_cell.size(); ++cell) {
      if (groups.of_cell[cell] >= 0) {
        lists_.of_cells[cell].push_back(places[static_cast<std::size_t>(groups.of_cell[cell])]);
      }
    }
    lists_.of_points.resize(document_.point_count());
    add_sets(document_.cell_sets, lists_.of_cells, lists_.empty_of_cells);
    add_sets(document_.point_sets, lists_.of_points, lists_.empty_of_points);
    keep_empty_ones();
    return std::move(lists_);
  }

 private:
  std::size_t place_of(const std::string& name) {
    const auto [known, is_new] = places_.try_emplace(name, lists_.names.size());
    if (is_new) {
      lists_.names.push_back(name);
    }
    return known->second;
  }

  void add_sets(const std::vector<NamedSet>& sets, std::vector<std::vector<std::size_t>>& of_each,
                std::vector<std::size_t>& empty) {
    for (const NamedSet& set : sets) {
      const std::size_t place = place_of(set.name);
      if (set.members.empty()) {
        empty.push_back(place);
      }
      for (const std::int32_t member : set.members) {
        of_each[static_cast<std::size_t>(member)].push_back(place);
      }
    }
    for (std::vector<std::size_t>& groups : of_each) {
      std::ranges::sort(groups);
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    }
  }

  /// A group may be empty under one name with others, or of cells and of points.
  void keep_empty_ones() {
    std::vector<bool> is_done(lists_.names.size());
    for (const auto* const of_each : {&lists_.of_cells, &lists_.of_points}) {
      for (const std::vector<std::size_t>& groups : *of_each) {
        std::ranges::for_each(groups, [&is_done](std::size_t place) { is_done[place] = true; });
      }
    }
    for (std::vector<std::size_t>* const empty : {&lists_.empty_of_cells, &lists_.empty_of_points}) {
      std::erase_if(*empty, [&is_done](std::size_t place) {
        const bool is_known = is_done[place];
        is_done[place] = true;
        return is_known;
      });
    }
  }

  const MeshDocument& document_;
  std::map<std::string, std::size_t> places_;
  GroupLists lists_;
};

std::string fitted(std::string name, std::size_t most, std::string_view others) {
  std::ranges::replace_if(
      name, [others](char c) { return static_cast<unsigned char>(c) < ' ' || others.find(c) != others.npos; }, '_');
  name = name.substr(std::min(name.find_first_not_of(' '), name.size()), most);
  name.erase(name.find_last_not_of(' ') + 1);
  return name.empty() ? "group" : name;
}

}  // namespace

GroupLists list_groups(const MeshDocument& document) {
  return GroupLister(document).list();
}

FittedNames fit_names(const std::vector<std::string>& names, std::size_t most, std::string_view others) {
  FittedNames fit;
  FreeNames taken;
  for (const std::string& name : names) {
    if (fitted(name, most, others) == name) {
      taken.take(name);
    }
  }
  for (const std::string& name : names) {
    std::string written = fitted(name, most, others);
    if (written != name) {
      // With room for a number behind it.
      constexpr std::size_t number_size = 12;
      written = taken.claim(fitted(written, most - number_size, others));
      fit.renamed.push_back(quoted(std::string_view(name)) + " (as " + written + ")");
    }
    fit.names.push_back(std::move(written));
  }
  return fit;
}

}  // namespace trismooth
