#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trismooth/base/workers.h"
#include "trismooth/smoothing/halo/halo.h"
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
  /// input number; empty: sizes are those that the mesh has. `halo`: of a part of a mesh; null: it is the whole.
  HostTargets(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
              Workers& workers, std::span<const double> inverse_sizes = {}, Halo* halo = nullptr)
      : halo_(halo), inverse_areas_(points.size()), largest_shares_(static_cast<std::size_t>(rings.free_count())) {
    if (inverse_sizes.empty()) {
      aim_at_input(points, rings, options, workers);
    } else {
      aim_at_sizes(points, rings, options, inverse_sizes, workers);
    }
    if (options.target == TargetShape::input) {
      std::vector<EdgeTensor<T>> around(points.size());
      for_rings(points, rings, workers,
                [&](std::int32_t v, const auto& ring) { around[v] = edges_around(points[v], ring); });
      update_ghosts(around);
      edges_.resize(points.size());
      for_rings(points, rings, workers,
                [&](std::int32_t v, const auto& ring) { edges_[v] = edges_nearby(v, around.data(), ring); });
      update_ghosts(edges_);
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
    const std::int32_t first_fixed = rings.first_fixed();
    std::vector<FixedVertexArea> fixed(points.size() - static_cast<std::size_t>(first_fixed));
    const MeanRatioSums sums =
        measure(points, rings, workers, [&](std::int32_t v, const auto& ring, MeanRatioSums& /*own*/) {
          for_fixed_corners(points[v], ring, first_fixed, [&](std::int32_t u, double area, std::uint64_t /*times*/) {
            raise(fixed[u - first_fixed].largest, std::bit_cast<std::uint64_t>(area));
          });
        });
    join_fixed(fixed, [](FixedVertexArea& own, const FixedVertexArea& other) {
      own.largest = std::max(own.largest, other.largest);
    });
    const MeanRatioMesh& mesh = mesh_ = MeanRatioMesh::of(sums, options.size_weight, options.power);
    scales_ = scales_of<T>(mesh);
    for_rings(points, rings, workers, [&](std::int32_t v, const auto& ring) {
      for_fixed_corners(points[v], ring, first_fixed, [&](std::int32_t u, double area, std::uint64_t times) {
        FixedVertexArea& around = fixed[u - first_fixed];
        add(around.sum, times * static_cast<std::uint64_t>(area * around.units()));
        add(around.count, times);
      });
      largest_shares_[v] = growth_bound(largest_shares_[v], inverse_areas_[v], mesh);
      inverse_areas_[v] = inverse_target_area(inverse_areas_[v], mesh);
    });
    join_fixed(fixed, [](FixedVertexArea& own, const FixedVertexArea& other) {
      own.sum += other.sum;
      own.count += other.count;
    });
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      inverse_areas_[static_cast<std::size_t>(first_fixed) + i] =
          inverse_target_area(static_cast<T>(fixed[i].mean()), mesh);
    }
    update_ghosts(inverse_areas_);
  }

  /// Ghosts get what their owners have.
  template <class V>
  void update_ghosts(std::vector<V>& values) {
    if (halo_ != nullptr) {
      halo_->update(std::span<V>(values));
    }
  }
  template <class Join>
  void join_fixed(std::vector<FixedVertexArea>& values, const Join& join) {
    if (halo_ != nullptr) {
      halo_->join_fixed(std::span<FixedVertexArea>(values), join);
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
    return halo_ == nullptr ? sums : of_all_parts(sums);
  }

  MeanRatioSums of_all_parts(MeanRatioSums sums) const {
    PartSums joined;
    const std::array<std::uint64_t*, 8> places{&sums.areas.parts[0], &sums.areas.parts[1], &sums.areas.parts[2],
                                               &sums.sizes.parts[0], &sums.sizes.parts[1], &sums.sizes.parts[2],
                                               &sums.quotients,      &sums.count};
    for (std::size_t i = 0; i < places.size(); ++i) {
      joined.sums[i] = static_cast<std::int64_t>(*places[i]);
    }
    // A key of 0 is none; keys of doubles that are not negative fall as these grow.
    const double nothing = -std::numeric_limits<double>::infinity();
    joined.largest = {sums.worst_quotient == 0 ? nothing : -sums.least_quotient(), nothing};
    halo_->links().join(joined);
    for (std::size_t i = 0; i < places.size(); ++i) {
      *places[i] = static_cast<std::uint64_t>(joined.sums[i]);
    }
    sums.worst_quotient = joined.largest[0] == nothing ? 0 : MeanRatioSums::key_of(-joined.largest[0]);
    return sums;
  }

  Halo* halo_ = nullptr;
  std::vector<T> inverse_areas_;   ///< one a vertex
  std::vector<T> largest_shares_;  ///< one a free vertex
  MeanRatioScales<T> scales_;
  MeanRatioMesh mesh_{};
  std::vector<EdgeTensor<T>> edges_;  ///< one a vertex, zeros of fixed ones; where shapes are to be kept
};

}  // namespace trismooth
