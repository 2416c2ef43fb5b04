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

  /// For smoothing from `points` (packed, local frame, working precision). `inverse_sizes`: of relative_sizes.h, by
  /// input number; empty: sizes are those that the mesh has.
  HostTargets(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
              Workers& workers, std::span<const double> inverse_sizes = {})
      : inverse_areas_(points.size()), largest_shares_(static_cast<std::size_t>(rings.free_count())) {
    if (inverse_sizes.empty()) {
      aim_at_input(points, rings, options, workers);
    } else {
      aim_at_sizes(points, rings, options, inverse_sizes, workers);
    }
    if (options.target == TargetShape::input) {
      std::vector<EdgeTensor<T>> around(points.size());
      for_rings(points, rings, workers,
                [&](std::int32_t v, const auto& ring) { around[v] = edges_around(points[v], ring); });
      edges_.resize(points.size());
      for_rings(points, rings, workers,
                [&](std::int32_t v, const auto& ring) { edges_[v] = edges_nearby(v, around.data(), ring); });
    }
  }

  /// What all vertices have in common.
  const MeanRatioMesh& mesh() const { return mesh_; }

  MeanRatioTargets<T> view() const {
    return {inverse_areas_.data(), largest_shares_.data(), &scales_, edges_.empty() ? nullptr : edges_.data()};
  }

 private:
  static constexpr std::int64_t grain = 1024;

  void aim_at_input(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
                    Workers& workers) {
    const std::int32_t free_count = rings.free_count();
    std::vector<FixedVertexArea> fixed(points.size() - static_cast<std::size_t>(free_count));
    const MeanRatioSums sums =
        measure(points, rings, workers, [&](std::int32_t v, const auto& ring, MeanRatioSums& /*own*/) {
          for_fixed_corners(points[v], ring, free_count, [&](std::int32_t u, double area, std::uint64_t /*times*/) {
            raise(fixed[u - free_count].largest, std::bit_cast<std::uint64_t>(area));
          });
        });
    const MeanRatioMesh& mesh = mesh_ = MeanRatioMesh::of(sums, options.size_weight, options.power);
    scales_ = scales_of<T>(mesh);
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
  }

  void aim_at_sizes(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
                    std::span<const double> inverse_sizes, Workers& workers) {
    std::vector<T> sizes(points.size());
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      sizes[v] = static_cast<T>(inverse_sizes[rings.input_index[v]]);
    }
    const MeanRatioSums sums =
        measure(points, rings, workers, [&](std::int32_t v, const auto& ring, MeanRatioSums& own) {
          add_sizes(v, points[v], sizes.data(), ring, own);
        });
    const MeanRatioMesh& mesh = mesh_ = MeanRatioMesh::of(sums, options.size_weight, options.power, true);
    scales_ = scales_of<T>(mesh);
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      inverse_areas_[v] = inverse_asked_area(sizes[v], mesh);
    }
    for (std::size_t v = 0; v < largest_shares_.size(); ++v) {
      largest_shares_[v] = growth_bound(largest_shares_[v], T(1) / inverse_areas_[v], mesh);
    }
  }

  static void add(std::uint64_t& sum, std::uint64_t value) {
    std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed);
  }
  static void add(AreaSum& sum, const AreaSum& more) {
    for (int i = 0; i < AreaSum::part_count; ++i) {
      add(sum.parts[i], more.parts[i]);
    }
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

  /// The first pass: leaves each vertex's mean area in inverse_areas_ and its largest share in largest_shares_. Calls
  /// visit(v, ring, sums) with what adds up.
  template <class Visit>
  MeanRatioSums measure(std::span<const Point2<T>> points, const PackedRings& rings, Workers& workers,
                        const Visit& visit) {
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
          visit(v, ring, own);
        });
      }
      add(sums.areas, own.areas);
      add(sums.sizes, own.sizes);
      add(sums.quotients, own.quotients);
      add(sums.count, own.count);
      raise(sums.worst_quotient, own.worst_quotient);
    });
    return sums;
  }

  std::vector<T> inverse_areas_;   ///< one a vertex
  std::vector<T> largest_shares_;  ///< one a free vertex
  MeanRatioScales<T> scales_;
  MeanRatioMesh mesh_{};
  std::vector<EdgeTensor<T>> edges_;  ///< one a vertex, zeros of fixed ones; where shapes are to be kept
};

}  // namespace trismooth
