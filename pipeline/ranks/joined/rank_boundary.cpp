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

/// A triangle on its way to rank 0.
struct SentBoundaryTriangle {
  struct Corner {
    std::int64_t id;
    Point2<double> place;
    std::uint8_t held;
  };

  std::int64_t id;
  std::array<Corner, 3> corners;
  std::uint8_t reversed;
};

/// One flag a vertex of the overlap: 1 where it is free, this rank's, and opposite of two on the boundary.
std::vector<std::uint8_t> apexes(const mpi::Overlap& overlap, std::span<const std::uint8_t> held) {
  std::vector<std::uint8_t> is_apex(overlap.ids.size(), 0);
  for (const Triangle& corners : overlap.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](std::size_t corner) { return held[static_cast<std::size_t>(corners[corner % 3])]; };
      const bool is_opposite = (at(i + 1) & at(i + 2) & hold::boundary) != 0;
      if (is_opposite && at(i) == 0 && overlap.is_own(corners[i])) {
        is_apex[static_cast<std::size_t>(corners[i])] = 1;
      }
    }
  }
  return is_apex;
}

CoarseBoundary judged(std::vector<SentBoundaryTriangle> near, int threads) {
  std::ranges::sort(near, {}, &SentBoundaryTriangle::id);
  near.erase(std::unique(near.begin(), near.end(),
                         [](const SentBoundaryTriangle& a, const SentBoundaryTriangle& b) { return a.id == b.id; }),
             near.end());
  std::vector<SentBoundaryTriangle::Corner> vertices;
  for (const SentBoundaryTriangle& triangle : near) {
    vertices.insert(vertices.end(), triangle.corners.begin(), triangle.corners.end());
  }
  std::ranges::sort(vertices, {}, &SentBoundaryTriangle::Corner::id);
  vertices.erase(
      std::unique(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.id == b.id; }),
      vertices.end());
  std::vector<Triangle> triangles(near.size());
  std::vector<std::uint8_t> reversed(near.size());
  for (std::size_t t = 0; t < near.size(); ++t) {
    std::ranges::transform(near[t].corners, triangles[t].begin(), [&](const SentBoundaryTriangle::Corner& corner) {
      const auto place = std::ranges::lower_bound(vertices, corner.id, {}, &SentBoundaryTriangle::Corner::id);
      return static_cast<std::int32_t>(place - vertices.begin());
    });
    reversed[t] = near[t].reversed;
  }
  std::vector<Point2<double>> points(vertices.size());
  std::vector<std::uint8_t> held(vertices.size());
  std::ranges::transform(vertices, points.begin(), &SentBoundaryTriangle::Corner::place);
  std::ranges::transform(vertices, held.begin(), &SentBoundaryTriangle::Corner::held);
  return find_coarse_boundary(TriangleView{points, triangles, reversed, 0}, held, threads);
}

}  // namespace

CoarseBoundary find_coarse_boundary(const RankTopology& topology, std::span<const Point2<double>> local,
                                    std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
                                    int threads) {
  const mpi::Communicator& ranks = topology.ranks();
  const mpi::Overlap& overlap = topology.overlap();
  const std::vector<std::uint8_t> is_apex = apexes(overlap, held);
  auto sent = mpi::lists_by_rank<SentBoundaryTriangle>(ranks);
  for (std::size_t t = 0; t < overlap.triangles.size(); ++t) {
    const Triangle& corners = overlap.triangles[t];
    const auto on_boundary =
        std::ranges::count_if(corners, [&](std::int32_t v) { return (held[v] & hold::boundary) != 0; });
    const bool is_behind = std::ranges::any_of(corners, [&](std::int32_t v) { return is_apex[v] != 0; });
    if ((topology.counts(t) && on_boundary >= 2) || is_behind) {
      SentBoundaryTriangle near{overlap.triangle_ids[t], {}, reversed[t]};
      std::ranges::transform(corners, near.corners.begin(), [&](std::int32_t v) {
        const auto place = static_cast<std::size_t>(v);
        return SentBoundaryTriangle::Corner{overlap.ids[place], local[place], held[place]};
      });
      sent[0].push_back(near);
    }
  }
  std::vector<SentBoundaryTriangle> all;
  for (const auto& list : ranks.exchanged(sent)) {
    all.insert(all.end(), list.begin(), list.end());
  }
  CoarseBoundary coarse;
  agree(ranks, [&] {
    if (ranks.rank() == 0) {
      coarse = judged(std::move(all), threads);
    }
  });
  static_assert(std::is_trivially_copyable_v<CoarseBoundary>);
  MPI_Bcast(&coarse, sizeof(coarse), MPI_BYTE, 0, ranks.handle());
  return coarse;
}

}  // namespace trismooth
