// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/inp/inp_reader.h"

#include <algorithm>
#include <set>
#include <utility>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/inp/inp_cells.h"
#include "trismooth/mesh_io/inp/inp_lines_reader.h"
#include "trismooth/mesh_io/inp/inp_original.h"
#include "trismooth/mesh_io/inp/inp_sets.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

/// Names, separated by commas, the first few of them.
template <class Names>
std::string listed_names(const Names& names) {
  constexpr std::size_t most_listed = 8;
  return first_of_list(names, most_listed);
}

void add_notes(const InpModel& model, std::size_t unknown_members, std::vector<std::string>& notes) {
  std::set<std::string> unknown_types;
  for (const InpElementBlock& block : model.blocks) {
    if (!block.known.is_known() || block.known.cell == cell_type::poly_vertex) {
      unknown_types.insert(trismooth::quoted(block.type));
    }
  }
  if (!unknown_types.empty()) {
    notes.push_back("what elements of type " + listed_names(unknown_types) +
                    " look like is not known: their nodes are held");
  }
  if (unknown_members > 0) {
    notes.push_back("sets name " + std::to_string(unknown_members) +
                    " nodes, elements or other sets that are not there; these lines stay as they are");
  }
  add_note_of_included(model.sources, notes);
  if (model.names_other_files) {
    notes.emplace_back("names files that hold no mesh (INPUT=, FILE=): output in another folder needs them there");
  }
}

/// Elements that join two faces keep their thickness: their nodes stay.
void hold_joined_faces(const InpModel& model, MeshDocument& document) {
  NamedSet held{"abaqus:cohesive", {}};
  std::int64_t elements = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (!joins_faces(model.blocks[b].type)) {
      continue;
    }
    const std::size_t end = b + 1 < model.blocks.size() ? model.blocks[b + 1].first_cell : document.cells.size();
    for (std::size_t cell = model.blocks[b].first_cell; cell < end; ++cell, ++elements) {
      const auto nodes = document.cells[cell];
      held.members.insert(held.members.end(), nodes.begin(), nodes.end());
    }
  }
  if (elements > 0) {
    document.notes.push_back(
        counted(elements, "cohesive or gasket element keeps its", "cohesive or gasket elements keep their") +
        " thickness: the nodes are held, which --fixed-set none lets go");
    document.implied_sets.push_back(std::move(held));
  }
}

/// The numbers of the nodes, where the file has one list of them: parts number each their own.
void add_labels(const InpModel& model, MeshDocument& document) {
  const auto has_nodes = [](const InpScope& scope) { return !scope.nodes.labels.empty(); };
  const auto scope = std::ranges::find_if(model.scopes, has_nodes);
  if (scope == model.scopes.end() || std::ranges::count_if(model.scopes, has_nodes) > 1) {
    return;
  }
  std::vector<std::int64_t> labels(document.point_count());
  for (std::size_t i = 0; i < scope->nodes.labels.size(); ++i) {
    labels[static_cast<std::size_t>(scope->nodes.indices[i])] = scope->nodes.labels[i];
  }
  set_point_labels(document, std::move(labels));
}

/// A node has all its coordinates nearly always, or all but z, which is 0 for all.
void drop_needless_gaps(InpModel& model) {
  bool is_flat = true;
  for (std::size_t i = 2; i < model.points.size() && is_flat; i += 3) {
    is_flat = model.points[i] == 0;
  }
  for (InpSource& source : model.sources) {
    if (is_flat) {
      std::erase_if(source.gaps, [](const InpGap& gap) { return gap.component == 2; });
    }
    source.gaps.shrink_to_fit();
  }
}

/// Sites whose vertices are simply all of them need no list of these.
void drop_needless_vertices(InpModel& model) {
  std::vector<NumberSites>& sites = model.sources.front().sites;
  if (model.sources.size() == 1 && sites.size() == 1 && sites.front().size() == model.node_offsets.size()) {
    sites.front().vertices = {};
  }
}

}  // namespace

InpModel read_inp_model(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  InpModel model;
  model.sources.push_back({path, std::move(bytes), {}, {}, {}});
  InpLinesReader(model, workers).read();
  return model;
}

MeshDocument read_inp(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  InpModel model = read_inp_model(path, std::move(bytes), workers);
  number_inp_items(model);
  MeshDocument document;
  document.cells = make_inp_cells(model);
  const std::size_t unknown_members = find_inp_members(model, document.cells);
  add_inp_sets(model, document);
  add_notes(model, unknown_members, document.notes);
  hold_joined_faces(model, document);
  document.most_coordinate_characters = 20;
  document.points = model.points;
  add_labels(model, document);
  drop_needless_gaps(model);
  drop_needless_vertices(model);
  document.original = make_inp_original(std::move(model.sources), std::move(model.points));
  return document;
}

}  // namespace trismooth
