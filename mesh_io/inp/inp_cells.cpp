// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_cells.h"

#include <utility>

#include "trismooth/mesh_io/inp/inp_text.h"

namespace trismooth {

namespace {

[[noreturn]] void fail_at_item(const InpModel& model, const InpOrigins& origins,
                               const std::vector<std::uint64_t>& offsets, std::size_t item,
                               const std::string& message) {
  const InpSource& source = model.sources[origins.source_of(item)];
  fail_in_inp(source.path, source.bytes, static_cast<std::size_t>(offsets[item]), message);
}

/// The place in the list of the first item whose label another one before it has.
std::optional<std::size_t> number_items(InpItems& items) {
  items.ids = PointIds(items.labels);
  return items.ids.first_repeated();
}

}  // namespace

void number_inp_items(InpModel& model) {
  for (InpScope& scope : model.scopes) {
    if (const auto repeated = number_items(scope.nodes)) {
      fail_at_item(model, model.node_origins, model.node_offsets,
                   static_cast<std::size_t>(scope.nodes.indices[*repeated]),
                   "there is a node " + std::to_string(scope.nodes.labels[*repeated]) + " before this one");
    }
    if (const auto repeated = number_items(scope.elements)) {
      fail_at_item(model, model.element_origins, model.element_offsets,
                   static_cast<std::size_t>(scope.elements.indices[*repeated]),
                   "there is an element " + std::to_string(scope.elements.labels[*repeated]) + " before this one");
    }
  }
}

std::optional<std::int32_t> find_inp_item(const InpModel& model, std::size_t scope, InpItems InpScope::*kind,
                                          std::int64_t label) {
  for (std::optional<std::size_t> in = scope; in; in = model.scopes[*in].part) {
    const InpItems& items = model.scopes[*in].*kind;
    if (const auto found = items.ids.find(label)) {
      return items.indices[static_cast<std::size_t>(*found)];
    }
  }
  return std::nullopt;
}

CellList make_inp_cells(const InpModel& model) {
  CellList cells;
  const std::size_t count = model.element_count();
  cells.offsets.reserve(count + 1);
  cells.types.reserve(count);
  cells.connectivity.reserve(model.references.size());
  auto foreign = model.foreign.begin();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const InpElementBlock& block = model.blocks[b];
    const std::size_t end = b + 1 < model.blocks.size() ? model.blocks[b + 1].first_cell : count;
    for (std::size_t cell = block.first_cell; cell < end; ++cell) {
      for (std::size_t i = model.element_begins[cell]; i < model.element_begins[cell + 1]; ++i) {
        std::size_t scope = block.scope;
        if (foreign != model.foreign.end() && foreign->first == i) {
          scope = (foreign++)->second;
        }
        const auto point = find_inp_item(model, scope, &InpScope::nodes, model.references[i]);
        if (!point) {
          fail_at_item(model, model.element_origins, model.element_offsets, cell,
                       "this element refers to node " + std::to_string(model.references[i]) + ", which there is not");
        }
        cells.connectivity.push_back(*point);
      }
      const std::uint8_t type = block.known.is_known() ? block.known.cell : cell_type::poly_vertex;
      if (type == cell_type::quadratic_edge) {
        // The middle node stands between the ends.
        std::swap(cells.connectivity.back(), cells.connectivity[cells.connectivity.size() - 2]);
      }
      cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
      cells.types.push_back(type);
    }
  }
  return cells;
}

}  // namespace trismooth
