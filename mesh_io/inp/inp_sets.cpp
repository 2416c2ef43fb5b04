// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_sets.h"

#include <algorithm>
#include <optional>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/inp/inp_cells.h"
#include "trismooth/mesh_io/inp/inp_text.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

class InpMembers {
 public:
  InpMembers(InpModel& model, const CellList& cells)
      : model_(model), cells_(cells), budget_(model.sources.front().path, size_of(model)) {}

  void find(InpItems InpScope::*kind, const std::vector<InpSetLines>& blocks, std::vector<InpSet>& sets) {
    for (const InpSetLines& block : blocks) {
      std::vector<std::int32_t>& members = sets[block.set].members;
      budget_.spend(static_cast<std::size_t>(block.behind - block.first));
      for (std::int32_t item = block.first; item < block.behind; ++item) {
        members.push_back(item);
      }
      for (const std::int64_t label : block.labels) {
        add(members, find_inp_item(model_, block.scope, kind, label));
      }
      for (const InpRange& range : block.ranges) {
        add_range(members, kind, block.scope, range);
      }
      for (const std::string& name : block.names) {
        add_named(members, kind, sets, block, name);
      }
      if (!block.elements.empty()) {
        add_nodes_of(members, find_inp_set(model_, block.scope, &InpScope::elements, block.elements));
      }
    }
  }

  std::size_t unknown() const { return unknown_; }

 private:
  static std::size_t size_of(const InpModel& model) {
    std::size_t bytes = 0;
    for (const InpSource& source : model.sources) {
      bytes += source.bytes.size();
    }
    return bytes;
  }

  void add(std::vector<std::int32_t>& members, std::optional<std::int32_t> item) {
    if (item) {
      members.push_back(*item);
    } else {
      ++unknown_;
    }
  }

  /// Numbers of a range that nothing has are left out without a word: ranges have gaps.
  void add_range(std::vector<std::int32_t>& members, InpItems InpScope::*kind, std::size_t scope,
                 const InpRange& range) {
    if (range.last < range.first) {
      return;
    }
    const auto steps = static_cast<std::uint64_t>(range.last - range.first) / static_cast<std::uint64_t>(range.step);
    std::size_t labels = 0;
    for (std::optional<std::size_t> in = scope; in; in = model_.scopes[*in].part) {
      labels += (model_.scopes[*in].*kind).labels.size();
    }
    if (steps <= labels) {
      budget_.spend(static_cast<std::size_t>(steps) + 1);
      for (std::uint64_t i = 0; i <= steps; ++i) {
        const std::int64_t label = range.first + static_cast<std::int64_t>(i) * range.step;
        if (const auto item = find_inp_item(model_, scope, kind, label)) {
          members.push_back(*item);
        }
      }
      return;
    }
    budget_.spend(labels);
    for (std::optional<std::size_t> in = scope; in; in = model_.scopes[*in].part) {
      const InpItems& items = model_.scopes[*in].*kind;
      for (std::size_t i = 0; i < items.labels.size(); ++i) {
        const std::int64_t label = items.labels[i];
        if (range.first <= label && label <= range.last && (label - range.first) % range.step == 0) {
          members.push_back(items.indices[i]);
        }
      }
    }
  }

  void add_named(std::vector<std::int32_t>& members, InpItems InpScope::*kind, const std::vector<InpSet>& sets,
                 const InpSetLines& block, std::string_view name) {
    if (const auto set = find_inp_set(model_, block.scope, kind, name)) {
      const std::vector<std::int32_t>& others = sets[*set].members;
      if (&others != &members) {
        budget_.spend(others.size());
        members.insert(members.end(), others.begin(), others.end());
      }
      return;
    }
    const std::size_t point = name.rfind('.');
    if (point != std::string_view::npos) {
      const auto instance = model_.instances.find(inp_key(name.substr(0, point)));
      const auto label = parse_integer(name.substr(point + 1));
      if (instance != model_.instances.end() && label) {
        add(members, find_inp_item(model_, instance->second, kind, *label));
        return;
      }
    }
    ++unknown_;
  }

  void add_nodes_of(std::vector<std::int32_t>& members, std::optional<std::size_t> element_set) {
    if (!element_set) {
      ++unknown_;
      return;
    }
    const std::size_t before = members.size();
    for (const std::int32_t cell : model_.element_sets[*element_set].members) {
      const auto vertices = cells_[static_cast<std::size_t>(cell)];
      budget_.spend(vertices.size());
      members.insert(members.end(), vertices.begin(), vertices.end());
    }
    std::sort(members.begin() + static_cast<std::ptrdiff_t>(before), members.end());
    members.erase(std::unique(members.begin() + static_cast<std::ptrdiff_t>(before), members.end()), members.end());
  }

  InpModel& model_;
  const CellList& cells_;
  MemberBudget budget_;
  std::size_t unknown_ = 0;
};

}  // namespace

std::optional<std::size_t> find_inp_set(const InpModel& model, std::size_t scope, InpItems InpScope::*kind,
                                        std::string_view text) {
  for (std::optional<std::size_t> in = scope; in; in = model.scopes[*in].part) {
    const InpNames& sets = (model.scopes[*in].*kind).sets;
    if (const auto found = sets.find(inp_key(text)); found != sets.end()) {
      return found->second;
    }
  }
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) {
    return std::nullopt;
  }
  const auto instance = model.instances.find(inp_key(text.substr(0, point)));
  return instance == model.instances.end() ? std::nullopt
                                           : find_inp_set(model, instance->second, kind, text.substr(point + 1));
}

std::size_t find_inp_members(InpModel& model, const CellList& cells) {
  InpMembers members(model, cells);
  members.find(&InpScope::elements, model.element_set_lines, model.element_sets);
  members.find(&InpScope::nodes, model.node_set_lines, model.node_sets);
  return members.unknown();
}

}  // namespace trismooth
