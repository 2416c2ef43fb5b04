// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/joined/rank_boundary.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "trismooth/base/hold.h"
#include "trismooth/pipeline/ranks/agreement.h"

namespace trismooth {

namespace {

/// An element on its way to rank 0.
struct SentBoundaryElement {
  struct Corner {
    std::int64_t id;
    Point2<double> place;
    std::uint8_t held;
  };

  std::int64_t id;
  std::array<Corner, 4> corners;
  std::uint8_t count;  ///< of the corners
  std::uint8_t reversed;
};

/// One flag a vertex of the overlap: 1 where it is free, this rank's, and behind the second of two corners on the
/// boundary that follow each other: find_coarse_boundary() asks for what is around it.
std::vector<std::uint8_t> apexes(const mpi::Overlap& overlap, std::span<const std::uint8_t> held) {
  std::vector<std::uint8_t> is_apex(overlap.ids.size(), 0);
  for (const std::span<const std::int32_t> corners : overlap.elements()) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t apex = corners[(i + 2) % corners.size()];
      const auto at = [&](std::int32_t v) { return held[static_cast<std::size_t>(v)]; };
      const bool is_opposite = (at(corners[i]) & at(next_corner(corners, i)) & hold::boundary) != 0;
      if (is_opposite && at(apex) == 0 && overlap.is_own(apex)) {
        is_apex[static_cast<std::size_t>(apex)] = 1;
      }
    }
  }
  return is_apex;
}

/// The elements with their corners as `vertices` has them by id.
template <class Corners>
std::vector<Corners> numbered(std::span<const SentBoundaryElement> near,
                              std::span<const SentBoundaryElement::Corner> vertices) {
  std::vector<Corners> elements(near.size());
  for (std::size_t t = 0; t < near.size(); ++t) {
    elements[t].fill(no_corner);
    for (std::size_t i = 0; i < near[t].count; ++i) {
      const auto place =
          std::ranges::lower_bound(vertices, near[t].corners[i].id, {}, &SentBoundaryElement::Corner::id);
      elements[t][i] = static_cast<std::int32_t>(place - vertices.begin());
    }
  }
  return elements;
}

CoarseBoundary judged(std::vector<SentBoundaryElement> near, bool are_triangles, int threads) {
  std::ranges::sort(near, {}, &SentBoundaryElement::id);
  near.erase(std::unique(near.begin(), near.end(),
                         [](const SentBoundaryElement& a, const SentBoundaryElement& b) { return a.id == b.id; }),
             near.end());
  std::vector<SentBoundaryElement::Corner> vertices;
  for (const SentBoundaryElement& element : near) {
    vertices.insert(vertices.end(), element.corners.begin(), element.corners.begin() + element.count);
  }
  std::ranges::sort(vertices, {}, &SentBoundaryElement::Corner::id);
  vertices.erase(
      std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id == b.id; }),
      vertices.end());
  std::vector<std::uint8_t> reversed(near.size());
  std::ranges::transform(near, reversed.begin(), &SentBoundaryElement::reversed);
  std::vector<Point2<double>> points(vertices.size());
  std::vector<std::uint8_t> held(vertices.size());
  std::ranges::transform(vertices, points.begin(), &SentBoundaryElement::Corner::place);
  std::ranges::transform(vertices, held.begin(), &SentBoundaryElement::Corner::held);
  if (are_triangles) {
    const std::vector<Triangle> triangles = numbered<Triangle>(near, vertices);
    return find_coarse_boundary(MeshView(points, triangles, reversed), held, threads);
  }
  const std::vector<MixedElement> elements = numbered<MixedElement>(near, vertices);
  return find_coarse_boundary(MeshView(points, elements, reversed), held, threads);
}

}  // namespace

CoarseBoundary find_coarse_boundary(const RankTopology& topology, std::span<const Point2<double>> local,
                                    std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
                                    int threads) {
  const mpi::Communicator& ranks = topology.ranks();
  const mpi::Overlap& overlap = topology.overlap();
  const std::vector<std::uint8_t> is_apex = apexes(overlap, held);
  auto sent = mpi::lists_by_rank<SentBoundaryElement>(ranks);
  const ElementList elements = overlap.elements();
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const std::span<const std::int32_t> corners = elements[t];
    const auto on_boundary =
        std::ranges::count_if(corners, [&](std::int32_t v) { return (held[v] & hold::boundary) != 0; });
    const bool is_behind = std::ranges::any_of(corners, [&](std::int32_t v) { return is_apex[v] != 0; });
    if ((topology.counts(t) && on_boundary >= 2) || is_behind) {
      SentBoundaryElement near{overlap.triangle_ids[t], {}, static_cast<std::uint8_t>(corners.size()), reversed[t]};
      std::ranges::transform(corners, near.corners.begin(), [&](std::int32_t v) {
        const auto place = static_cast<std::size_t>(v);
        return SentBoundaryElement::Corner{overlap.ids[place], local[place], held[place]};
      });
      sent[0].push_back(near);
    }
  }
  std::vector<SentBoundaryElement> all;
  for (const auto& list : ranks.exchanged(sent)) {
    all.insert(all.end(), list.begin(), list.end());
  }
  CoarseBoundary coarse;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      coarse = judged(std::move(all), elements.are_triangles(), threads);
    }
  });
  static_assert(std::is_trivially_copyable_v<CoarseBoundary>);
  MPI_Bcast(&coarse, sizeof(coarse), MPI_BYTE, 0, ranks.handle());
  return coarse;
}

}  // namespace trismooth
