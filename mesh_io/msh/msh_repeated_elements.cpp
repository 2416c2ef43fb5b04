// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_repeated_elements.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace trismooth {

namespace {

/// An entity, by the dimension of its elements and its tag.
using MshEntityName = std::pair<int, std::int32_t>;

class MshRepeatedElements {
 public:
  MshRepeatedElements(CellList& cells, MshElements& elements) : cells_(cells), elements_(elements) {}

  void merge() {
    std::vector<std::int32_t> candidates = elements_of_entities_in_groups();
    if (candidates.empty()) {
      return;
    }
    // By type and nodes, and those alike in the file's order.
    std::ranges::sort(candidates, [this](std::int32_t a, std::int32_t b) {
      const int order = compare(a, b);
      return order < 0 || (order == 0 && a < b);
    });
    std::vector<std::int32_t> first_alike(cells_.size(), -1);
    for (std::size_t i = 1; i < candidates.size(); ++i) {
      const auto before = static_cast<std::size_t>(candidates[i - 1]);
      const auto element = static_cast<std::size_t>(candidates[i]);
      const bool is_alike = compare(candidates[i - 1], candidates[i]) == 0;
      const std::size_t first = !is_alike                 ? element
                                : first_alike[before] < 0 ? before
                                                          : static_cast<std::size_t>(first_alike[before]);
      // The same in the same group is the file's own business.
      if (is_alike && elements_.physical[element] != elements_.physical[first]) {
        first_alike[element] = static_cast<std::int32_t>(first);
        ++elements_.repeated;
      }
    }
    if (elements_.repeated > 0) {
      take_out(first_alike);
    }
  }

 private:
  MshEntityName entity_of(std::size_t element) const {
    return {cell_type::dimension(cells_.types[element]), elements_.geometrical[element]};
  }

  std::vector<std::int32_t> elements_of_entities_in_groups() const {
    std::map<MshEntityName, std::int32_t> groups;
    std::set<MshEntityName> several;
    MshEntityName last{-1, 0};
    std::int32_t group = 0;
    for (std::size_t element = 0; element < cells_.size(); ++element) {
      if (const MshEntityName entity = entity_of(element); entity != last || elements_.physical[element] != group) {
        last = entity;
        group = elements_.physical[element];
        if (groups.try_emplace(entity, group).first->second != group) {
          several.insert(entity);
        }
      }
    }
    std::vector<std::int32_t> found;
    for (std::size_t element = 0; element < cells_.size() && !several.empty(); ++element) {
      if (several.contains(entity_of(element))) {
        found.push_back(static_cast<std::int32_t>(element));
      }
    }
    return found;
  }

  /// Less than, equal to or greater than 0, by entity, type and nodes.
  int compare(std::int32_t a, std::int32_t b) const {
    const auto first = static_cast<std::size_t>(a);
    const auto second = static_cast<std::size_t>(b);
    const auto in_order = [](const auto& x, const auto& y) { return x < y ? -1 : y < x ? 1 : 0; };
    if (const int order = in_order(entity_of(first), entity_of(second)); order != 0) {
      return order;
    }
    if (const int order = in_order(cells_.types[first], cells_.types[second]); order != 0) {
      return order;
    }
    const auto of_first = cells_[first];
    const auto of_second = cells_[second];
    if (std::ranges::lexicographical_compare(of_first, of_second)) {
      return -1;
    }
    return std::ranges::lexicographical_compare(of_second, of_first) ? 1 : 0;
  }

  void take_out(const std::vector<std::int32_t>& first_alike) {
    CellList kept;
    std::size_t count = 0;
    elements_.cells.resize(cells_.size());
    for (std::size_t element = 0; element < cells_.size(); ++element) {
      if (first_alike[element] < 0) {
        elements_.cells[element] = static_cast<std::int32_t>(count);
        kept.append(cells_.types[element], cells_[element]);
        ++count;
      }
    }
    for (std::size_t element = 0; element < cells_.size(); ++element) {
      if (first_alike[element] >= 0) {
        const std::int32_t cell = elements_.cells[static_cast<std::size_t>(first_alike[element])];
        elements_.cells[element] = cell;
        if (elements_.physical[element] != 0) {
          const int dimension = cell_type::dimension(cells_.types[element]);
          std::vector<std::int32_t>& members = elements_.further_groups[{dimension, elements_.physical[element]}];
          if (members.empty() || members.back() != cell) {
            members.push_back(cell);
          }
        }
      }
    }
    const auto keep = [&](std::vector<std::int32_t>& labels) {
      std::size_t to = 0;
      for (std::size_t element = 0; element < labels.size(); ++element) {
        if (first_alike[element] < 0) {
          labels[to++] = labels[element];
        }
      }
      labels.resize(to);
    };
    keep(elements_.physical);
    keep(elements_.geometrical);
    keep(elements_.partition);
    cells_ = std::move(kept);
  }

  CellList& cells_;
  MshElements& elements_;
};

}  // namespace

void merge_repeated_elements(CellList& cells, MshElements& elements) {
  MshRepeatedElements(cells, elements).merge();
}

}  // namespace trismooth
