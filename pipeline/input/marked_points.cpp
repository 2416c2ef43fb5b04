// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/marked_points.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <unordered_map>

#include "trismooth/base/splitmix64.h"
#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/document/region_names.h"

namespace trismooth {

namespace {

constexpr std::int32_t none = -1;

/// The vertices inside a region that have the same marker.
struct Group {
  std::int32_t region = 0;
  std::int32_t marker = 0;
  std::int64_t vertices = 0;
  std::int64_t amid_alike = 0;  ///< those all of whose neighbours are of the group, too
  bool surrounds = false;       ///< the vertices of marker 0 in the region, or where it has none the largest group
  bool is_marked = false;

  /// (One vertex and what is around it may be an electrode.)
  bool is_area() const { return amid_alike > 1 && 6 * amid_alike > vertices; }
};

struct Region {
  std::int64_t vertices = 0;
  std::int64_t marked = 0;
  std::int64_t sides = 0;  ///< of elements, between two that are marked: two an edge
  const Group* surrounding = nullptr;

  /// Whether the marked are few, or lie on curves, on which there are about as many edges as vertices.
  bool has_marks() const { return 3 * marked <= vertices || (5 * marked <= 2 * vertices && 5 * sides < 12 * marked); }
};

/// Per vertex: 1 where a neighbour is not of its group.
std::vector<std::uint8_t> find_changes(const ElementList& elements, std::span<const std::int32_t> group_of) {
  std::vector<std::uint8_t> changes(group_of.size(), 0);
  for (const auto corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t next = next_corner(corners, i);
      if (group_of[corners[i]] != group_of[next]) {
        changes[corners[i]] = changes[next] = 1;
      }
    }
  }
  return changes;
}

/// The groups, in the order of their first vertices. `group_of`: gets the one of each vertex inside.
std::vector<Group> find_groups(const ElementList& elements, std::span<const std::int32_t> markers,
                               std::span<const std::int32_t> regions_inside, std::vector<std::int32_t>& group_of) {
  std::vector<Group> groups;
  std::unordered_map<std::int64_t, std::int32_t> numbers;
  group_of.assign(markers.size(), none);
  for (std::size_t v = 0; v < markers.size(); ++v) {
    if (const std::int32_t region = regions_inside[v]; region != none) {
      const auto next = static_cast<std::int32_t>(groups.size());
      const auto [number, is_new] = numbers.try_emplace((std::int64_t{region} << 32) + markers[v], next);
      if (is_new) {
        groups.push_back({region, markers[v]});
      }
      group_of[v] = number->second;
      ++groups[group_of[v]].vertices;
    }
  }
  const std::vector<std::uint8_t> changes = find_changes(elements, group_of);
  for (std::size_t v = 0; v < markers.size(); ++v) {
    if (group_of[v] != none && changes[v] == 0) {
      ++groups[group_of[v]].amid_alike;
    }
  }
  return groups;
}

/// Finds which groups surround and which are marked, region by region.
void judge(const ElementList& elements, std::span<const std::int32_t> group_of, std::int32_t zero,
           std::vector<Group>& groups) {
  const auto last = std::ranges::max_element(groups, {}, &Group::region);
  std::vector<Region> regions(last == groups.end() ? 0 : static_cast<std::size_t>(last->region) + 1);
  const auto region_of = [&](const Group& group) -> Region& { return regions[group.region]; };
  const auto rank = [zero](const Group& group) {
    return std::tuple(group.marker == zero, group.vertices, -group.marker);
  };
  for (const Group& group : groups) {
    Region& region = region_of(group);
    region.vertices += group.vertices;
    if (region.surrounding == nullptr || rank(group) > rank(*region.surrounding)) {
      region.surrounding = &group;
    }
  }
  for (Group& group : groups) {
    group.surrounds = region_of(group).surrounding == &group;
    group.is_marked = !group.surrounds && !group.is_area();
    region_of(group).marked += group.is_marked ? group.vertices : 0;
  }
  const auto marked_group = [&](std::int32_t v) {
    const std::int32_t g = group_of[v];
    return g != none && groups[g].is_marked ? &groups[g] : nullptr;
  };
  for (const auto corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Group* const first = marked_group(corners[i]);
      const Group* const second = first != nullptr ? marked_group(next_corner(corners, i)) : nullptr;
      if (second != nullptr && first->region == second->region) {
        ++region_of(*first).sides;
      }
    }
  }
  for (Group& group : groups) {
    group.is_marked = group.is_marked && region_of(group).has_marks();
  }
}

}  // namespace

bool may_be_markers(std::string_view name, ScalarType type, std::uint64_t components) {
  return components == 1 && type != ScalarType::float32 && type != ScalarType::float64 && is_marker_name(name);
}

std::vector<std::int32_t> find_regions_inside(const ElementList& elements, std::span<const std::int32_t> regions,
                                              std::span<const std::uint8_t> is_held) {
  constexpr std::int32_t unseen = -2;
  std::vector<std::int32_t> inside(is_held.size(), unseen);
  // Of a vertex inside each neighbour is met twice, and what is met twice leaves nothing behind.
  std::vector<std::uint64_t> left(is_held.size(), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::int32_t region = regions.empty() ? 0 : regions[e];
    const auto corners = elements[e];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t v = corners[i];
      left[v] ^= splitmix64(static_cast<std::uint64_t>(next_corner(corners, i))) ^
                 splitmix64(static_cast<std::uint64_t>(previous_corner(corners, i)));
      std::int32_t& of_vertex = inside[v];
      of_vertex = of_vertex == unseen || of_vertex == region ? region : none;
    }
  }
  for (std::size_t v = 0; v < inside.size(); ++v) {
    if (inside[v] == unseen || left[v] != 0 || is_held[v] != 0) {
      inside[v] = none;
    }
  }
  return inside;
}

MarkedPoints find_marked_points(const ElementList& elements, std::span<const std::int32_t> markers, std::int32_t zero,
                                std::span<const std::int32_t> regions_inside) {
  std::vector<std::int32_t> group_of;
  std::vector<Group> groups = find_groups(elements, markers, regions_inside, group_of);
  judge(elements, group_of, zero, groups);
  MarkedPoints points;
  for (std::size_t v = 0; v < markers.size(); ++v) {
    if (group_of[v] != none) {
      const Group& group = groups[group_of[v]];
      points.others += group.surrounds || group.is_marked ? 0 : 1;
      if (group.is_marked) {
        points.vertices.push_back(static_cast<std::int32_t>(v));
      }
    }
  }
  return points;
}

std::vector<std::string> notes_of_marked_points(const std::string& array, const MarkedPoints& points,
                                                const std::string& ids) {
  std::vector<std::string> notes;
  if (const auto count = std::ssize(points.vertices); count > 0) {
    const std::string them = count == 1 ? "it" : "them";
    notes.push_back(counted(count, "vertex", "vertices") + " inside, which '" + array +
                    "' marks otherwise than what surrounds " + them + ": held fixed; --fixed-set none frees " + them);
  }
  if (points.others > 0) {
    notes.push_back(counted(points.others, "vertex inside has", "vertices inside have") + " values of '" + array +
                    "' that are no marks, being too many or of whole areas: held by nothing; " + ids +
                    " holds vertices");
  }
  return notes;
}

}  // namespace trismooth
