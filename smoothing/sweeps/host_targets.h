#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"

namespace trismooth {

/// What the mean-ratio method aims at, in memory of the host.
template <class T>
class HostTargets {
 public:
  /// None.
  HostTargets() = default;

  /// For smoothing from `points` (packed, local frame, working precision).
  HostTargets(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
              Workers& workers)
      : inverse_areas_(points.size(), T(0)), largest_shares_(static_cast<std::size_t>(rings.free_count())) {
    const MeanRatioMesh mesh = MeanRatioMesh::of(measure(points, rings, workers), options.size_weight);
    half_size_weight_ = static_cast<T>(mesh.half_size_weight);
    workers.for_blocks(rings.free_count(), grain, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t v = begin; v < end; ++v) {
        largest_shares_[v] = growth_bound(largest_shares_[v], inverse_areas_[v], mesh);
        inverse_areas_[v] = inverse_target_area(inverse_areas_[v], mesh);
      }
    });
    if (options.target == TargetShape::input) {
      reference_.assign(points.begin(), points.end());
    }
  }

  MeanRatioTargets<T> view() const {
    static_assert(sizeof(Point2<T>) == 2 * sizeof(T));
    return {inverse_areas_.data(), largest_shares_.data(), &half_size_weight_,
            reference_.empty() ? nullptr : &reference_.front().x};
  }

 private:
  static constexpr std::int64_t grain = 1024;

  /// The first pass: leaves each vertex's mean area in inverse_areas_ and its largest share in largest_shares_.
  MeanRatioSums measure(std::span<const Point2<T>> points, const PackedRings& rings, Workers& workers) {
    std::atomic<std::uint64_t> areas{0};
    std::atomic<std::uint64_t> quotients{0};
    std::atomic<std::uint64_t> count{0};
    const RingView view = rings.view();
    workers.for_blocks(rings.free_count(), grain, [&](std::int64_t begin, std::int64_t end) {
      RingGatherer<T> gatherer;
      MeanRatioSums sums;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        const MeanRatioRing<T> found = gatherer.with_ring(
            points, view[v], [&](const auto& ring) { return measure_for_mean_ratio(points[v], ring); });
        sums.add(found.sums);
        inverse_areas_[v] = found.mean_area;
        largest_shares_[v] = found.largest_share;
      }
      areas.fetch_add(sums.areas, std::memory_order_relaxed);
      quotients.fetch_add(sums.quotients, std::memory_order_relaxed);
      count.fetch_add(sums.count, std::memory_order_relaxed);
    });
    return {areas, quotients, count};
  }

  std::vector<T> inverse_areas_;   ///< one a vertex
  std::vector<T> largest_shares_;  ///< one a free vertex
  T half_size_weight_ = 0;
  std::vector<Point2<T>> reference_;
};

}  // namespace trismooth
