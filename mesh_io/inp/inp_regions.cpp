// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "trismooth/mesh_io/inp/inp_sets.h"

namespace trismooth {

namespace {

/// Names of parts' sets that another scope has too are told apart by the part.
std::vector<std::string> unique_names(const InpModel& model, const std::vector<InpSet>& sets) {
  std::map<std::string, std::size_t, std::less<>> counts;
  for (const InpSet& set : sets) {
    ++counts[set.name];
  }
  std::vector<std::string> names;
  for (const InpSet& set : sets) {
    const std::string& scope = model.scopes[set.scope].name;
    names.push_back(counts[set.name] > 1 && !scope.empty() ? scope + "." + set.name : set.name);
  }
  return names;
}

/// The element sets that are regions, in the order of their numbers.
std::vector<std::size_t> sets_of_sections(const InpModel& model) {
  std::vector<std::size_t> regions;
  for (const InpSection& section : model.sections) {
    const auto set = find_inp_set(model, section.scope, &InpScope::elements, section.elements);
    if (set && !model.element_sets[*set].members.empty() && std::ranges::find(regions, *set) == regions.end()) {
      regions.push_back(*set);
    }
  }
  return regions;
}

std::vector<std::size_t> sets_of_keyword_lines(const InpModel& model) {
  std::vector<std::size_t> regions;
  for (std::size_t set = 0; set < model.element_sets.size(); ++set) {
    if (model.element_sets[set].is_of_lines && !model.element_sets[set].members.empty()) {
      regions.push_back(set);
    }
  }
  return regions;
}

/// The members of the set, ascending, each once.
std::vector<std::int32_t> distinct_members(const InpSet& set) {
  std::vector<std::int32_t> members = set.members;
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
  return members;
}

/// The smaller sets last, and of those alike the first.
std::vector<std::size_t> by_falling_size(const InpModel& model, const std::vector<std::size_t>& sets) {
  std::vector<std::pair<std::size_t, std::size_t>> sizes;
  for (const std::size_t set : sets) {
    sizes.emplace_back(distinct_members(model.element_sets[set]).size(), set);
  }
  std::ranges::sort(sizes, std::greater());
  std::vector<std::size_t> falling;
  std::ranges::transform(sizes, std::back_inserter(falling), [](const auto& size) { return size.second; });
  return falling;
}

/// Sets of which each two share no element or one is part of the other, but for those of all elements. Programs write
/// `all` beside the regions that it is made of.
std::vector<std::size_t> separate_sets(const InpModel& model) {
  const std::size_t cells = model.element_count();
  std::vector<std::size_t> candidates;
  for (std::size_t set = 0; set < model.element_sets.size(); ++set) {
    const std::size_t distinct = distinct_members(model.element_sets[set]).size();
    if (distinct > 0 && (distinct < cells || model.element_sets.size() == 1)) {
      candidates.push_back(set);
    }
  }
  constexpr auto nothing = static_cast<std::size_t>(-1);
  std::vector<std::size_t> largest(cells, nothing);            // of the sets so far that have the cell
  std::vector<std::size_t> counts(model.element_sets.size());  // of the cells whose largest set it is
  std::vector<bool> is_cut(model.element_sets.size());
  std::vector<std::size_t> rising = by_falling_size(model, candidates);
  std::ranges::reverse(rising);
  for (const std::size_t set : rising) {
    const std::vector<std::int32_t> members = distinct_members(model.element_sets[set]);
    std::vector<std::size_t> met;
    for (const std::int32_t member : members) {
      std::size_t& other = largest[static_cast<std::size_t>(member)];
      if (other != nothing) {
        met.push_back(other);
        --counts[other];
      }
      other = set;
    }
    for (const std::size_t other : met) {
      // Some of its cells are outside of the larger one.
      if (counts[other] > 0) {
        is_cut[other] = true;
        is_cut[set] = true;
      }
    }
    counts[set] = members.size();
  }
  std::erase_if(candidates, [&is_cut](std::size_t set) { return is_cut[set]; });
  return candidates;
}

std::vector<std::size_t> find_regions(const InpModel& model) {
  std::vector<std::size_t> regions = sets_of_sections(model);
  if (regions.empty()) {
    regions = sets_of_keyword_lines(model);
    // One name for all elements tells no regions apart, where other sets may.
    if (regions.size() < 2) {
      std::vector<std::size_t> separate = separate_sets(model);
      if (separate.size() > regions.size()) {
        return separate;
      }
    }
  }
  return regions;
}

}  // namespace

void add_inp_sets(const InpModel& model, MeshDocument& document) {
  const std::vector<std::string> names = unique_names(model, model.element_sets);
  const std::vector<std::size_t> regions = find_regions(model);
  std::vector<bool> is_region(model.element_sets.size(), false);
  if (!regions.empty()) {
    std::vector<std::int32_t> values(document.cells.size(), 0);
    std::vector<std::int32_t> values_of_sets(model.element_sets.size());
    for (std::size_t region = 0; region < regions.size(); ++region) {
      values_of_sets[regions[region]] = static_cast<std::int32_t>(region) + 1;
    }
    // Where sets overlap, an element is of the smallest.
    for (const std::size_t set : by_falling_size(model, regions)) {
      for (const std::int32_t cell : model.element_sets[set].members) {
        values[static_cast<std::size_t>(cell)] = values_of_sets[set];
      }
    }
    for (const std::size_t set : regions) {
      is_region[set] = std::ranges::all_of(model.element_sets[set].members, [&](std::int32_t cell) {
        return values[static_cast<std::size_t>(cell)] == values_of_sets[set];
      });
    }
    std::map<std::pair<int, std::int32_t>, bool> used;
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      if (values[cell] > 0) {
        used[{cell_type::dimension(document.cells.types[cell]), values[cell]}] = true;
      }
    }
    auto description = std::make_shared<ArrayDescription>();
    for (const auto& entry : used) {
      const auto& [dimension, value] = entry.first;
      description->value_names.push_back({value, dimension, names[regions[static_cast<std::size_t>(value) - 1]]});
    }
    DataArray array = make_data_array("abaqus:elset", 1, std::move(values));
    array.description = std::move(description);
    document.cell_arrays.push_back(std::move(array));
  }
  for (std::size_t set = 0; set < model.element_sets.size(); ++set) {
    if (!is_region[set]) {
      document.cell_sets.push_back({names[set], model.element_sets[set].members});
    }
  }
  const std::vector<std::string> node_names = unique_names(model, model.node_sets);
  for (std::size_t set = 0; set < model.node_sets.size(); ++set) {
    // Conditions that name sets alone, no nodes by number, are no set of their own.
    const bool is_set = !model.node_sets[set].members.empty() || !model.node_sets[set].name.starts_with('*');
    if (is_set) {
      document.point_sets.push_back({node_names[set], model.node_sets[set].members});
    }
  }
}

}  // namespace trismooth
