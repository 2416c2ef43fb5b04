// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/held_text.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/base/text/list_text.h"

namespace trismooth {

namespace {

std::string quoted_names(const std::vector<RegionArray>& arrays) {
  return list_text(arrays, [](const RegionArray& array) { return "'" + array.name + "'"; });
}

std::vector<FilePointSet> held_sets(const std::vector<FilePointSet>& sets) {
  std::vector<FilePointSet> held;
  std::ranges::copy_if(sets, std::back_inserter(held), &FilePointSet::holds);
  return held;
}

/// "4 'Corners', 12 'RequiredVertices'": of many groups the first.
template <class Group>
std::string counted_names(const std::vector<Group>& groups, std::int64_t Group::*count) {
  constexpr std::size_t most = 12;
  const std::size_t shown = groups.size() <= most + 1 ? groups.size() : most;
  const std::string names = list_text(std::span(groups).first(shown), [count](const Group& group) {
    return fmt::format("{} '{}'", group.*count, group.name);
  });
  return shown < groups.size() ? names + fmt::format(" and {} more", groups.size() - shown) : names;
}

void add_reason(std::vector<std::string>& reasons, std::int64_t count, std::string_view what) {
  if (count > 0) {
    reasons.push_back(fmt::format("{} {}", count, what));
  }
}

/// What the mesh itself says, with that text of its interfaces, if any.
std::vector<std::string> reasons_of(const HeldVertices& held, std::string interface,
                                    std::string_view of_others = "of other cells") {
  std::vector<std::string> reasons;
  add_reason(reasons, held.boundary, "boundary");
  if (!interface.empty()) {
    reasons.push_back(std::move(interface));
  }
  add_reason(reasons, held.non_manifold, "non-manifold");
  add_reason(reasons, held.bow_tie, "bow tie");
  add_reason(reasons, held.other_cells, of_others);
  add_reason(reasons, held.unused, "unused");
  add_reason(reasons, held.layers, "in layers");
  return reasons;
}

/// "140 boundary, 672 interface, 8 of them both"
std::string joined_reasons(const std::vector<std::string>& reasons, std::int64_t several) {
  std::string text = list_text(reasons, [](const std::string& reason) { return reason; });
  if (several > 0) {
    text += fmt::format(", {} of them {}", several, reasons.size() == 2 ? "both" : "for several reasons");
  }
  return text;
}

}  // namespace

std::string held_counts_text(const HeldVertices& held) {
  std::vector<std::string> reasons =
      reasons_of(held, held.interface > 0 ? fmt::format("{} interface", held.interface) : "");
  add_reason(reasons, held.named, "named");
  return joined_reasons(reasons, held.several);
}

std::string line_groups_text(const InputSummary& input) {
  return counted_names(input.line_groups, &FileLineGroup::vertices);
}

std::string held_text(const InputSummary& input) {
  const HeldVertices& held = input.held;
  std::string interface = held.interface > 0 ? fmt::format("{} interface", held.interface) : "";
  if (!input.region_arrays.empty()) {
    interface = input.regions == 1
                    ? fmt::format("no interface ({} is one region)", quoted_names(input.region_arrays))
                    : fmt::format("{} interface ({})", held.interface, quoted_names(input.region_arrays));
  }
  std::vector<std::string> reasons =
      reasons_of(held, std::move(interface), input.has_lines_alone() ? "of lines" : "of other cells");
  if (!input.fixed_array.empty()) {
    reasons.push_back(fmt::format("{} by the array '{}'", input.fixed_array_vertices, input.fixed_array));
  }
  if (const std::string sets = counted_names(held_sets(input.point_sets), &FilePointSet::vertices); !sets.empty()) {
    reasons.push_back(fmt::format("named by the file ({})", sets));
  }
  if (input.fixed_ids_vertices > 0 || !input.fixed_ids.empty()) {
    reasons.push_back(fmt::format("{} by the file {}", input.fixed_ids_vertices, input.fixed_ids.string()));
  }
  const std::string text = fmt::format("{} of {}", input.fixed_vertices, input.vertices - input.middle_nodes);
  return reasons.empty() ? text : text + ": " + joined_reasons(reasons, held.several);
}

std::string_view describe(RegionReason reason) {
  switch (reason) {
    case RegionReason::named:
      return "named with --region-array";
    case RegionReason::known_name:
      return "by its name";
    case RegionReason::looks_like_regions:
      break;
  }
  return "looks like regions";
}

std::string_view topology_text(Topology found_by) {
  switch (found_by) {
    case Topology::halfedge:
      return "found by OpenMesh halfedges";
    case Topology::device:
      return "found by the device, from the list of elements";
    default:
      return "found by the host, from the list of elements";
  }
}

}  // namespace trismooth
