#include <algorithm>
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

/// Sets that share no element with another, but for those of all elements.
std::vector<std::size_t> separate_sets(const InpModel& model) {
  const std::size_t cells = model.element_count();
  std::vector<std::int32_t> last(cells, -1);  // the set that a cell was met in last
  std::vector<bool> is_shared(cells, false);
  std::vector<std::size_t> candidates;
  for (std::size_t set = 0; set < model.element_sets.size(); ++set) {
    std::vector<std::int32_t> sorted = model.element_sets[set].members;
    std::ranges::sort(sorted);
    const auto distinct = static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
    if (distinct > 0 && (distinct < cells || model.element_sets.size() == 1)) {
      candidates.push_back(set);
    }
  }
  for (const std::size_t set : candidates) {
    for (const std::int32_t member : model.element_sets[set].members) {
      const auto cell = static_cast<std::size_t>(member);
      is_shared[cell] = is_shared[cell] || (last[cell] >= 0 && last[cell] != static_cast<std::int32_t>(set));
      last[cell] = static_cast<std::int32_t>(set);
    }
  }
  std::erase_if(candidates, [&](std::size_t set) {
    return std::ranges::any_of(model.element_sets[set].members,
                               [&](std::int32_t cell) { return is_shared[static_cast<std::size_t>(cell)]; });
  });
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
    for (std::size_t region = 0; region < regions.size(); ++region) {
      is_region[regions[region]] = true;
      for (const std::int32_t cell : model.element_sets[regions[region]].members) {
        values[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(region) + 1;
      }
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
