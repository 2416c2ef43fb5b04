// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/nastran/nastran_reader.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/included_sources.h"
#include "trismooth/mesh_io/document/point_ids.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/nastran/nastran_deck_reader.h"
#include "trismooth/mesh_io/nastran/nastran_model.h"
#include "trismooth/mesh_io/nastran/nastran_original.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

[[noreturn]] void fail_in_nastran(const NastranModel& model, const NastranPlace& place, const std::string& message) {
  const NastranSource& source = model.sources[place.source];
  TextScanner(source.bytes, source.path).fail_at(place.offset, message);
}

template <class Names>
std::string listed_nastran_names(const Names& names) {
  constexpr std::size_t most_listed = 12;
  return first_of_list(names, most_listed, trismooth::quoted);
}

CellList make_nastran_cells(const NastranModel& model, const PointIds& ids) {
  CellList cells;
  cells.types = model.element_types;
  cells.offsets.assign(model.element_begins.begin(), model.element_begins.end());
  cells.connectivity.reserve(model.references.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (std::size_t i = model.element_begins[cell]; i < model.element_begins[cell + 1]; ++i) {
      const auto point = ids.find(model.references[i]);
      if (!point) {
        fail_in_nastran(model, model.element_places[cell],
                        "the element names node " + std::to_string(model.references[i]) + ", which has no GRID");
      }
      cells.connectivity.push_back(*point);
    }
  }
  return cells;
}

void add_properties(NastranModel& model, MeshDocument& document) {
  if (std::ranges::all_of(model.properties, [](std::int64_t property) { return property == 0; })) {
    return;
  }
  std::set<std::pair<int, std::int64_t>> used;
  std::pair<int, std::int64_t> last{-1, 0};
  for (std::size_t cell = 0; cell < model.properties.size(); ++cell) {
    const std::pair now{cell_type::dimension(document.cells.types[cell]), model.properties[cell]};
    if (now != last) {
      used.insert(last = now);
    }
  }
  ArrayDescription description;
  for (const auto& [dimension, property] : used) {
    if (const auto named = model.property_names.find(property); named != model.property_names.end()) {
      description.value_names.push_back({property, dimension, named->second});
    }
  }
  DataArray array = make_data_array("nastran:pid", 1, std::move(model.properties));
  if (!description.empty()) {
    array.description = std::make_shared<const ArrayDescription>(std::move(description));
  }
  document.cell_arrays.push_back(std::move(array));
}

/// Nodes between numbers: those of a range, each once for all ranges of a set.
class NastranRanges {
 public:
  explicit NastranRanges(const std::vector<std::int64_t>& ids) {
    sorted_.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      sorted_.emplace_back(ids[i], static_cast<std::int32_t>(i));
    }
    std::ranges::sort(sorted_);
  }

  std::vector<std::int32_t> members(std::vector<NastranRange> ranges) const {
    std::ranges::sort(ranges, {}, &NastranRange::first);
    std::vector<std::int32_t> found;
    auto next = sorted_.begin();
    for (const NastranRange& range : ranges) {
      next = std::lower_bound(next, sorted_.end(), std::pair{range.first, std::int32_t{0}});
      for (; next != sorted_.end() && next->first <= range.last; ++next) {
        found.push_back(next->second);
      }
    }
    return found;
  }

 private:
  std::vector<std::pair<std::int64_t, std::int32_t>> sorted_;
};

void add_held(const NastranModel& model, MeshDocument& document) {
  if (model.held.empty()) {
    return;
  }
  // As many sets as there are may name all nodes by two numbers each.
  std::size_t budget = std::size_t{1} << 20;
  for (const NastranSource& source : model.sources) {
    budget += 16 * source.bytes.size();
  }
  const NastranRanges nodes(model.node_ids);
  for (const auto& [name, ranges] : model.held) {
    std::vector<std::int32_t> members = nodes.members(ranges);
    if (members.size() > budget) {
      throw ReadError(model.sources.front().path, "its constraints name more nodes than a mesh of its size can have");
    }
    budget -= members.size();
    if (!members.empty()) {
      document.point_sets.push_back({name, std::move(members)});
    }
  }
}

void add_notes(const NastranModel& model, std::vector<std::string>& notes) {
  if (!model.other_cards.empty()) {
    notes.push_back("Cards that are kept in Nastran output only: " + listed_nastran_names(model.other_cards) + ".");
  }
  if (!model.partly_curved.empty()) {
    notes.push_back("Some nodes in the middle of edges are left out of elements " +
                    listed_nastran_names(model.partly_curved) + ": the others of these are held.");
  }
  if (model.system != 0) {
    notes.push_back("All nodes are in the coordinate system " + std::to_string(model.system) +
                    ": the mesh is taken as it is in that.");
  }
  if (model.has_short_free_grids) {
    notes.emplace_back(
        "New numbers of nodes in free field take up to 16 characters, of which a solver may read 8 digits or so; in "
        "large field (GRID*) it reads them all.");
  }
  add_note_of_included(model.sources, notes);
}

/// Sources whose vertices are simply all of them need no list of these.
void drop_needless_vertices(NastranModel& model) {
  if (model.sources.size() == 1) {
    model.sources.front().vertices = {};
  }
}

}  // namespace

MeshDocument read_nastran(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  NastranModel model;
  model.sources.push_back({path, std::move(bytes), {}, {}, {}});
  NastranDeckReader(model, workers).read();
  const PointIds ids(model.node_ids);
  if (const auto repeated = ids.first_repeated()) {
    fail_in_nastran(model, place_of_nastran_node(model, *repeated),
                    "there is a node " + std::to_string(model.node_ids[*repeated]) + " before this one");
  }
  MeshDocument document;
  document.cells = make_nastran_cells(model, ids);
  add_properties(model, document);
  add_held(model, document);
  add_notes(model, document.notes);
  document.most_coordinate_characters = most_nastran_characters;
  document.coordinate_form = NumberForm::nastran;
  document.points = std::move(model.points);
  set_point_labels(document, std::move(model.node_ids));
  drop_needless_vertices(model);
  document.original = make_nastran_original(std::move(model.sources), document.points);
  return document;
}

}  // namespace trismooth
