// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_components.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "trismooth/mpi/directory.h"

namespace trismooth {

namespace {

/// A component of a rank's overlap.
struct ComponentPart {
  std::int32_t rank;
  std::int32_t component;

  auto operator<=>(const ComponentPart&) const = default;
};

/// What a rank counts of one of its components.
struct ComponentCount {
  ComponentPart part;
  std::int64_t triangles = 0;
  std::int64_t reversed = 0;

  std::int64_t reoriented() const { return std::min(reversed, triangles - reversed); }
};

/// Whether other ranks have the element as well.
bool is_shared(const mpi::Overlap& overlap, std::size_t element) {
  return !std::ranges::all_of(overlap.elements()[element], [&](std::int32_t v) { return overlap.is_own(v); });
}

/// Pairs of parts that have a triangle in common, on rank 0: enough of them to join all parts of a component.
std::vector<std::pair<ComponentPart, ComponentPart>> joints(const RankTopology& topology) {
  struct Placed {
    std::int64_t triangle;
    std::int32_t component;
  };
  const mpi::Communicator& ranks = topology.ranks();
  const mpi::Overlap& overlap = topology.overlap();
  auto sent = mpi::lists_by_rank<Placed>(ranks);
  for (std::size_t t = 0; t < overlap.elements().size(); ++t) {
    if (is_shared(overlap, t)) {
      const std::int64_t id = overlap.triangle_ids[t];
      sent[static_cast<std::size_t>(mpi::home_of(id, ranks))].push_back({id, topology.topology().component[t]});
    }
  }
  const mpi::ByRank<Placed> heard = ranks.exchanged(sent);
  std::map<std::int64_t, ComponentPart> first;
  std::set<std::pair<ComponentPart, ComponentPart>> found;
  for (std::size_t r = 0; r < heard.size(); ++r) {
    for (const Placed& placed : heard[r]) {
      const ComponentPart part{static_cast<std::int32_t>(r), placed.component};
      const auto [place, is_first] = first.emplace(placed.triangle, part);
      if (!is_first) {
        found.emplace(place->second, part);
      }
    }
  }
  using Joint = std::pair<ComponentPart, ComponentPart>;
  std::vector<std::array<ComponentPart, 2>> flat;
  for (const Joint& joint : found) {
    flat.push_back({joint.first, joint.second});
  }
  auto gathered = mpi::lists_by_rank<std::array<ComponentPart, 2>>(ranks);
  gathered[0] = flat;
  std::vector<Joint> all;
  for (const auto& list : ranks.exchanged(gathered)) {
    for (const auto& [a, b] : list) {
      all.emplace_back(a, b);
    }
  }
  return all;
}

/// Joins the counts of parts that are of one component.
RankComponents joined_components(std::vector<ComponentCount> counts,
                                 const std::vector<std::pair<ComponentPart, ComponentPart>>& joints) {
  std::map<ComponentPart, std::size_t> places;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    places.emplace(counts[i].part, i);
  }
  std::vector<std::size_t> root(counts.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) {
      i = root[i] = root[root[i]];
    }
    return i;
  };
  for (const auto& [a, b] : joints) {
    root[root_of(places.at(a))] = root_of(places.at(b));
  }
  std::map<std::size_t, ComponentCount> components;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    ComponentCount& whole = components[root_of(i)];
    whole.triangles += counts[i].triangles;
    whole.reversed += counts[i].reversed;
  }
  RankComponents result;
  for (const auto& [place, whole] : components) {
    ++result.count;
    result.reoriented_triangles += whole.reoriented();
  }
  return result;
}

}  // namespace

RankComponents count_components(const RankTopology& topology, std::span<const std::uint8_t> reversed) {
  const mpi::Communicator& ranks = topology.ranks();
  const mpi::Overlap& overlap = topology.overlap();
  std::vector<ComponentCount> counts(static_cast<std::size_t>(topology.topology().components));
  std::vector<std::uint8_t> goes_on(counts.size(), 0);
  for (std::size_t t = 0; t < overlap.elements().size(); ++t) {
    const auto c = static_cast<std::size_t>(topology.topology().component[t]);
    counts[c].part = {ranks.rank(), static_cast<std::int32_t>(c)};
    counts[c].triangles += topology.counts(t) ? 1 : 0;
    counts[c].reversed += topology.counts(t) && reversed[t] != 0 ? 1 : 0;
    goes_on[c] = is_shared(overlap, t) ? 1 : goes_on[c];
  }
  RankComponents result;
  auto sent = mpi::lists_by_rank<ComponentCount>(ranks);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (goes_on[c] != 0) {
      sent[0].push_back(counts[c]);
    } else {
      ++result.count;
      result.reoriented_triangles += counts[c].reoriented();
    }
  }
  std::vector<ComponentCount> gathered;
  for (const auto& list : ranks.exchanged(sent)) {
    gathered.insert(gathered.end(), list.begin(), list.end());
  }
  const auto found = joints(topology);
  if (ranks.rank() == 0) {
    const RankComponents across = joined_components(std::move(gathered), found);
    result.count += across.count;
    result.reoriented_triangles += across.reoriented_triangles;
  }
  return {ranks.sum(result.count), ranks.sum(result.reoriented_triangles)};
}

}  // namespace trismooth
