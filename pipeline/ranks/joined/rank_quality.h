// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/quality/precision_loss.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/quality/region_quality.h"
#include "trismooth/quality/size_change.h"

namespace trismooth {

/// Reports on the whole mesh. Triangles go to the ranks in blocks by their numbers, whoever has them, and what blocks
/// contribute is added up from rank to rank in the order of the blocks: every figure is that of the reports of the mesh
/// as one file, to the bit, for every number of ranks. Corners travel in rounds, so that no rank ever has those of all
/// its triangles. All points are of the overlap, in a local frame.
class RankQuality {
 public:
  /// All is of the overlap. `reversed` and `held` as RankTopology has them; `regions`: a number a triangle, or none.
  /// The topology and `reversed` outlive it. Collective.
  RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
              std::span<const std::int32_t> regions, std::int32_t region_count);

  /// WorstElement::triangle is a number in the whole mesh, and the centroid in the units of the file. Collective.
  QualityReport report(std::span<const Point2<double>> points, const LocalFrame& frame, int threads) const;
  /// Of each region; empty where there are no two. Collective.
  std::vector<RegionQuality> regions(std::span<const Point2<double>> points) const;
  /// How sizes changed: size_change(). Collective.
  SizeChange size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                         std::span<const Point2<double>> after, const LocalFrame& frame_after, int threads) const;
  /// What single precision loses: single_precision_loss(). Collective.
  PrecisionLoss precision_loss(std::span<const Point2<double>> points, int exponent, int threads) const;

 private:
  std::int64_t first_block(int rank) const { return blocks_ * rank / ranks_.size(); }
  std::int64_t rounds() const;
  /// Where the triangles of a round begin, among those that a rank reports on.
  std::int64_t first_of_round(int rank, std::int64_t round) const;
  /// The corners of the triangles of a round that are reported here, three of each.
  BulkVector<Point2<double>> corners_of_round(std::span<const Point2<double>> points, std::int64_t round) const;
  /// Calls visit(view, number) for the triangles reported here, those of a round after those of the last: `number`, of
  /// the first one of the view, is that among all that are reported here.
  template <class Visit>
  void for_rounds(std::span<const Point2<double>> points, int exponent, const Visit& visit) const;

  const RankTopology& topology_;
  const mpi::Communicator& ranks_;
  std::span<const std::uint8_t> reversed_;
  std::int64_t blocks_;                   ///< of triangles of the whole mesh
  mpi::ByRank<std::int32_t> sent_;        ///< triangles of the overlap, by the rank that reports on them
  mpi::ByRank<std::int32_t> places_;      ///< of triangles that come from each rank, among those reported here
  std::vector<std::uint8_t> all_fixed_;   ///< one a triangle reported here: 1 where no corner can move
  std::vector<std::int32_t> regions_;     ///< of these likewise; empty where there are no two
  std::vector<Triangle> corner_numbers_;  ///< of the triangles of a round: 3 t, 3 t + 1, 3 t + 2
  std::int32_t region_count_;
};

}  // namespace trismooth
