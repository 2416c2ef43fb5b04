#pragma once

#include <atomic>
#include <bit>
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
      : inverse_areas_(points.size()), largest_shares_(static_cast<std::size_t>(rings.free_count())) {
    const std::int32_t free_count = rings.free_count();
    std::vector<FixedVertexArea> fixed(points.size() - static_cast<std::size_t>(free_count));
    const MeanRatioSums sums = measure(points, rings, fixed, workers);
    const MeanRatioMesh mesh = MeanRatioMesh::of(sums, options.size_weight, options.power);
    scales_ = {static_cast<T>(mesh.size_weight), mesh.power};
    for_rings(points, rings, workers, [&](std::int32_t v, const auto& ring) {
      for_fixed_corners(points[v], ring, free_count, [&](std::int32_t u, double area, std::uint64_t times) {
        FixedVertexArea& around = fixed[u - free_count];
        add(around.sum, times * static_cast<std::uint64_t>(area * around.units()));
        add(around.count, times);
      });
      largest_shares_[v] = growth_bound(largest_shares_[v], inverse_areas_[v], mesh);
      inverse_areas_[v] = inverse_target_area(inverse_areas_[v], mesh);
    });
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      inverse_areas_[static_cast<std::size_t>(free_count) + i] =
          inverse_target_area(static_cast<T>(fixed[i].mean()), mesh);
    }
    if (options.target == TargetShape::input) {
      reference_.assign(points.begin(), points.end());
    }
  }

  MeanRatioTargets<T> view() const {
    static_assert(sizeof(Point2<T>) == 2 * sizeof(T));
    return {inverse_areas_.data(), largest_shares_.data(), &scales_,
            reference_.empty() ? nullptr : &reference_.front().x};
  }

 private:
  static constexpr std::int64_t grain = 1024;

  static void add(std::uint64_t& sum, std::uint64_t value) {
    std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed);
  }
  static void raise(std::uint64_t& largest, std::uint64_t value) {
    const std::atomic_ref shared(largest);
    std::uint64_t seen = shared.load(std::memory_order_relaxed);
    while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
  }

  /// Calls visit(v, ring) for every free vertex.
  template <class Visit>
  static void for_rings(std::span<const Point2<T>> points, const PackedRings& rings, Workers& workers,
                        const Visit& visit) {
    const RingView view = rings.view();
    workers.for_blocks(rings.free_count(), grain, [&](std::int64_t begin, std::int64_t end) {
      RingGatherer<T> gatherer;
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        gatherer.with_ring(points, view[v], [&](const auto& ring) { visit(v, ring); });
      }
    });
  }

  /// The first pass: leaves each vertex's mean area in inverse_areas_ and its largest share in largest_shares_.
  MeanRatioSums measure(std::span<const Point2<T>> points, const PackedRings& rings,
                        std::vector<FixedVertexArea>& fixed, Workers& workers) {
    MeanRatioSums sums{};
    const RingView view = rings.view();
    workers.for_blocks(rings.free_count(), grain, [&](std::int64_t begin, std::int64_t end) {
      RingGatherer<T> gatherer;
      MeanRatioSums own{};  // threads meet once a block, not at every vertex
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        gatherer.with_ring(points, view[v], [&](const auto& ring) {
          const MeanRatioRing<T> found = measure_for_mean_ratio(points[v], ring);
          own.add(found.sums);
          inverse_areas_[v] = found.mean_area;
          largest_shares_[v] = found.largest_share;
          for_fixed_corners(points[v], ring, rings.free_count(),
                            [&](std::int32_t u, double area, std::uint64_t /*times*/) {
                              raise(fixed[u - rings.free_count()].largest, std::bit_cast<std::uint64_t>(area));
                            });
        });
      }
      add(sums.areas, own.areas);
      add(sums.quotients, own.quotients);
      add(sums.count, own.count);
    });
    return sums;
  }

  std::vector<T> inverse_areas_;   ///< one a vertex
  std::vector<T> largest_shares_;  ///< one a free vertex
  MeanRatioScales<T> scales_;
  std::vector<Point2<T>> reference_;
};

}  // namespace trismooth
