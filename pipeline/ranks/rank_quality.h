#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/pipeline/ranks/rank_topology.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/quality/region_quality.h"
#include "trismooth/quality/size_change.h"

namespace trismooth {

/// Reports on the whole mesh. Triangles go to the ranks in blocks by their numbers, whoever has them, and what blocks
/// contribute is added up from rank to rank in the order of the blocks: every figure is that of the reports of the mesh
/// as one file, to the bit, for every number of ranks. Collective.
class RankQuality {
 public:
  /// All is of the overlap. `reversed` and `held` as RankTopology has them; `regions`: a number a triangle, or none.
  RankQuality(const RankTopology& topology, std::span<const std::uint8_t> reversed, std::span<const std::uint8_t> held,
              std::span<const std::int32_t> regions, std::int32_t region_count);

  /// The corners of this rank's triangles, at those points of the overlap, which are in a local frame.
  std::vector<Point2<double>> corners_at(std::span<const Point2<double>> points) const;

  /// WorstElement::triangle is a number in the whole mesh, and the centroid in the units of the file.
  QualityReport report(std::span<const Point2<double>> corners, const LocalFrame& frame, int threads) const;
  /// Of each region; empty where there are no two.
  std::vector<RegionQuality> regions(std::span<const Point2<double>> corners) const;
  SizeChange size_change(std::span<const Point2<double>> before, const LocalFrame& frame_before,
                         std::span<const Point2<double>> after, const LocalFrame& frame_after, int threads) const;
  /// For what looks at each triangle by itself. The view is of `corners`.
  TriangleView view(std::span<const Point2<double>> corners, int exponent) const;

 private:
  /// What goes to the rank that reports on a triangle.
  struct Reported {
    std::int64_t id;
    std::int32_t region;
    std::uint8_t all_fixed;
  };

  const mpi::Communicator& ranks_;
  std::vector<Triangle> canonical_;       ///< of the triangles that this rank sends, in the numbers of the overlap
  mpi::ByRank<std::int32_t> sent_;        ///< places in canonical_, by the rank that reports on them
  mpi::ByRank<std::int64_t> places_;      ///< of triangles that come from each rank, among those reported here
  std::vector<Reported> reported_;        ///< here, ascending by id, without a gap
  std::vector<Triangle> corner_numbers_;  ///< of each of them: 3 t, 3 t + 1, 3 t + 2
  std::int32_t region_count_;
};

}  // namespace trismooth
