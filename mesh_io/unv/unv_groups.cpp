// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/unv/unv_groups.h"

#include <algorithm>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/cells/listed_groups.h"

namespace trismooth {

namespace {

/// The places of those ids that there are, ascending, each once.
std::vector<std::int32_t> places_of(const std::vector<std::int64_t>& ids, const PointIds& known) {
  std::vector<std::int32_t> places;
  for (const std::int64_t id : ids) {
    if (const auto place = known.find(id)) {
      places.push_back(*place);
    }
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

bool names_others(const std::vector<std::int64_t>& ids, const PointIds& known) {
  return std::ranges::any_of(ids, [&known](std::int64_t id) { return !known.find(id); });
}

}  // namespace

void add_unv_groups(std::vector<UnvGroup> groups, const PointIds& nodes, const PointIds& elements,
                    MeshDocument& document) {
  std::vector<ListedGroup> listed;
  std::string with_others;
  for (UnvGroup& group : groups) {
    if (group.name.empty()) {
      group.name = "group " + std::to_string(group.number);
    }
    if (names_others(group.nodes, nodes) || names_others(group.elements, elements)) {
      add_to_list(with_others, group.name);
    }
    std::vector<std::int32_t> points = places_of(group.nodes, nodes);
    std::vector<std::int32_t> cells = places_of(group.elements, elements);
    const bool is_of_cells = points.empty() || !cells.empty();
    if (!points.empty()) {
      document.point_sets.push_back({group.name, std::move(points)});
    }
    if (is_of_cells) {
      listed.push_back({group.number, std::move(group.name), std::move(cells)});
    }
  }
  add_listed_groups("unv:group", std::move(listed), document);
  if (!with_others.empty()) {
    document.notes.push_back("Groups name nodes or elements that are not in the file: " + with_others + ".");
  }
}

}  // namespace trismooth
