// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/rank_layers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth::mpi {

namespace {

/// A candidate with the ids of its corners.
struct SentCandidate {
  std::array<std::int64_t, 3> ids;
  FlatTriangle flat;
};

/// What rank 0 has found.
struct Findings {
  bool finds_any() const { return !kept.empty() || !left.empty(); }

  std::vector<std::int64_t> kept;  ///< ids, ascending
  std::vector<std::int64_t> left;  ///< likewise
  std::vector<LayersResult> result;
};

Findings search(const ByRank<SentCandidate>& by_rank, Layers layers, std::int64_t least, Workers& workers) {
  std::vector<std::int64_t> ids;
  for (const auto& candidates : by_rank) {
    for (const SentCandidate& candidate : candidates) {
      ids.insert(ids.end(), candidate.ids.begin(), candidate.ids.end());
    }
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<FlatTriangle> flat;
  for (const auto& candidates : by_rank) {
    for (const SentCandidate& candidate : candidates) {
      flat.push_back(candidate.flat);
      std::ranges::transform(candidate.ids, flat.back().corners.begin(), [&](std::int64_t id) {
        return static_cast<std::int32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
      });
    }
  }
  const LayerSearch found = search_layers(flat, static_cast<std::int32_t>(ids.size()), layers, least, workers);
  Findings findings;
  for (const auto& [places, found_ids] : {std::pair(&found.kept, &findings.kept), {&found.left, &findings.left}}) {
    for (const std::int32_t place : *places) {
      found_ids->push_back(ids[static_cast<std::size_t>(place)]);
    }
  }
  findings.result = {found.result};
  return findings;
}

/// What rank 0 finds among the candidates of all ranks, on all of them. Collective.
Findings shared_findings(const Overlap& overlap, std::span<const FlatTriangle> candidates, Layers layers,
                         std::int64_t least, const Communicator& ranks, Workers& workers) {
  auto to_first = lists_by_rank<SentCandidate>(ranks);
  for (const FlatTriangle& flat : candidates) {
    // Each goes from the owner of its first vertex.
    if (overlap.is_own(std::ranges::min(flat.corners))) {
      const auto id = [&](std::size_t i) { return overlap.ids[static_cast<std::size_t>(flat.corners[i])]; };
      to_first[0].push_back({{id(0), id(1), id(2)}, flat});
    }
  }
  const ByRank<SentCandidate> all = ranks.exchanged(std::move(to_first));
  Findings found;
  ranks.on_all([&] {
    if (ranks.rank() == 0) {
      found = search(all, layers, least, workers);
    }
  });
  ranks.broadcast(found.kept);
  ranks.broadcast(found.left);
  ranks.broadcast(found.result);
  return found;
}

/// The vertices of the overlap with these ids, both ascending.
std::vector<std::int32_t> vertices_here(const Overlap& overlap, std::span<const std::int64_t> ids) {
  std::vector<std::int32_t> found;
  for (std::int32_t v = 0; v < overlap.vertex_count(); ++v) {
    if (std::ranges::binary_search(ids, overlap.ids[static_cast<std::size_t>(v)])) {
      found.push_back(v);
    }
  }
  return found;
}

/// hold_layers() by these triangles of the overlap.
LayersResult hold_layers_among(std::span<const Triangle> triangles, std::span<const std::uint8_t> reversed,
                               const Overlap& overlap, std::span<const Point2<double>> points, Layers layers,
                               bool slides, std::span<std::uint8_t> fixed, const Communicator& ranks,
                               Workers& workers) {
  GhostValues ghosts(overlap.part);
  const LayerCandidates candidates(points, triangles, reversed, workers,
                                   [&ghosts](std::span<FlatAround> around) { ghosts.update(around); });
  Findings found = shared_findings(overlap, candidates.after(layers_first_choices, workers), layers, layers_least_seen,
                                   ranks, workers);
  if (!found.finds_any()) {
    return {};
  }
  found = shared_findings(overlap, candidates.after(layers_choices, workers), layers, layers_least, ranks, workers);
  LayersResult own;
  LayersResult ghost;
  std::vector<std::int32_t> kept = vertices_here(overlap, found.kept);
  add_ends(candidates.after(0, workers), kept);
  for (const std::int32_t v : kept) {
    if (count_in_layer(fixed[v], slides, overlap.is_own(v) ? own : ghost)) {
      fixed[v] |= hold::named;
    }
  }
  ghosts.update(fixed);  // not all of what is around them is here
  for (const std::int32_t v : vertices_here(overlap, found.left)) {
    own.left += overlap.is_own(v) && fixed[v] == 0 ? 1 : 0;
  }
  LayersResult result = found.result.front();
  result.left = ranks.sum(own.left);
  result.kept = ranks.sum(own.kept);
  result.kept_on_lines = ranks.sum(own.kept_on_lines);
  return result;
}

}  // namespace

LayersResult hold_layers(const Overlap& overlap, std::span<const Point2<double>> points,
                         std::span<const std::uint8_t> reversed, Layers layers, bool slides,
                         std::span<std::uint8_t> fixed, const Communicator& ranks, Workers& workers) {
  if (layers == Layers::smooth) {
    return {};
  }
  return overlap.elements().visit([&]<class Corners>(std::span<const Corners> listed) {
    if constexpr (std::is_same_v<Corners, Triangle>) {
      return hold_layers_among(listed, reversed, overlap, points, layers, slides, fixed, ranks, workers);
    } else {
      const CutElements cut = cut_into_triangles(points, listed, reversed);
      return hold_layers_among(cut.triangles, cut.reversed, overlap, points, layers, slides, fixed, ranks, workers);
    }
  });
}

}  // namespace trismooth::mpi
