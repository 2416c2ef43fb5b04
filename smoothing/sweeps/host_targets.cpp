// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/host_targets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"

namespace trismooth {

namespace {

void add(std::uint64_t& sum, std::uint64_t value) {
  std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed);
}
void raise(std::uint64_t& largest, std::uint64_t value) {
  const std::atomic_ref shared(largest);
  std::uint64_t seen = shared.load(std::memory_order_relaxed);
  while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

MeanRatioSums of_all_parts(const Halo& halo, MeanRatioSums sums) {
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
  halo.messenger().join(joined);
  for (std::size_t i = 0; i < places.size(); ++i) {
    *places[i] = static_cast<std::uint64_t>(joined.sums[i]);
  }
  sums.worst_quotient = joined.largest[0] == nothing ? 0 : MeanRatioSums::key_of(-joined.largest[0]);
  return sums;
}

}  // namespace

/// Fills in targets, in passes over all rings.
template <class T>
class HostTargets<T>::Finder {
 public:
  Finder(HostTargets& targets, std::span<const Point2<T>> points, const PackedRings& rings, Workers& workers,
         Halo* halo)
      : targets_(targets), points_(points), rings_(rings), view_(rings.view()), workers_(workers), halo_(halo) {}

  void aim_at_input(const MeanRatioOptions& options) {
    const std::int32_t first_fixed = rings_.first_fixed();
    std::vector<FixedVertexArea> fixed(points_.size() - static_cast<std::size_t>(first_fixed));
    const MeanRatioSums sums = measure([&](std::int32_t v, const auto& ring, MeanRatioSums& /*own*/) {
      for_fixed_corners(points_[v], ring, first_fixed, [&](std::int32_t u, double area, std::uint64_t /*times*/) {
        raise(fixed[u - first_fixed].largest, std::bit_cast<std::uint64_t>(area));
      });
    });
    join_fixed(fixed, [](FixedVertexArea& own, const FixedVertexArea& other) {
      own.largest = std::max(own.largest, other.largest);
    });
    const MeanRatioMesh mesh = MeanRatioMesh::of(sums, options.size_weight, options.power);
    set_mesh(mesh);
    for_rings([&](std::int32_t v, const auto& ring) {
      for_fixed_corners(points_[v], ring, first_fixed, [&](std::int32_t u, double area, std::uint64_t times) {
        FixedVertexArea& around = fixed[u - first_fixed];
        add(around.sum, times * static_cast<std::uint64_t>(area * around.units()));
        add(around.count, times);
      });
      share(v) = growth_bound(share(v), inverse_area(v), mesh);
      inverse_area(v) = inverse_target_area(inverse_area(v), mesh);
    });
    join_fixed(fixed, [](FixedVertexArea& own, const FixedVertexArea& other) {
      own.sum += other.sum;
      own.count += other.count;
    });
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      targets_.inverse_areas_[static_cast<std::size_t>(first_fixed) + i] =
          inverse_target_area(static_cast<T>(fixed[i].mean()), mesh);
    }
    update_ghosts(targets_.inverse_areas_);
  }

  void aim_at_sizes(const MeanRatioOptions& options, std::span<const double> inverse_sizes) {
    std::vector<T> sizes(points_.size());
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      sizes[v] = static_cast<T>(inverse_sizes[rings_.input_index[v]]);
    }
    const MeanRatioSums sums = measure([&](std::int32_t v, const auto& ring, MeanRatioSums& own) {
      add_sizes(v, points_[v], sizes.data(), ring, own);
    });
    const MeanRatioMesh mesh = MeanRatioMesh::of(sums, options.size_weight, options.power, true);
    set_mesh(mesh);
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      targets_.inverse_areas_[v] = inverse_asked_area(sizes[v], mesh);
    }
    for (std::int32_t v = 0; v < rings_.free_count(); ++v) {
      share(v) = growth_bound(share(v), T(1) / inverse_area(v), mesh);
    }
  }

  /// Brings targets of the mesh at `reference` to this one, see HostTargets::moved().
  void move_from(std::span<const Point2<T>> reference, int exponents) {
    targets_.scale_by(exponents);
    for_rings([&](std::int32_t v, const auto& ring) {
      share(v) = std::max(share(v), measure_for_mean_ratio(points_[v], ring).largest_share);
      if (!targets_.edges_.empty()) {
        const Point2<T> turn = turn_of_edges(v, points_[v], ring, [&](std::int32_t u) { return reference[u]; });
        targets_.edges_[v] = turned(targets_.edges_[v], turn);
      }
    });
    update_ghosts(targets_.edges_);
  }

  void find_edges() {
    std::vector<EdgeTensor<T>> around(points_.size());
    for_rings([&](std::int32_t v, const auto& ring) { around[v] = edges_around(points_[v], ring); });
    update_ghosts(around);
    std::vector<EdgeTensor<T>>& edges = targets_.edges_;
    edges.resize(points_.size());
    for_rings([&](std::int32_t v, const auto& ring) { edges[v] = edges_nearby(v, around.data(), ring); });
    update_ghosts(edges);
  }

 private:
  static constexpr std::int64_t grain = 1024;

  T& inverse_area(std::int32_t v) { return targets_.inverse_areas_[v]; }
  T& share(std::int32_t v) { return targets_.largest_shares_[v]; }

  void set_mesh(const MeanRatioMesh& mesh) {
    targets_.mesh_ = mesh;
    targets_.scales_ = scales_of<T>(mesh);
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

  /// Calls visit(v, ring, sums) for every free vertex; the sums that they add up to.
  template <class Visit>
  MeanRatioSums sum_over_rings(const Visit& visit) {
    return joined_blocks(
        rings_.free_count(), grain, workers_, MeanRatioSums{},
        [&](std::int64_t begin, std::int64_t end, MeanRatioSums& own) {
          RingGatherer<T> gatherer;
          for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
            gatherer.visit(points_, view_, v, [&](const auto& ring) { visit(v, ring, own); });
          }
        },
        [](MeanRatioSums& all, const MeanRatioSums& own) { all.add(own); });
  }
  template <class Visit>
  void for_rings(const Visit& visit) {
    sum_over_rings([&](std::int32_t v, const auto& ring, MeanRatioSums& /*own*/) { visit(v, ring); });
  }

  /// The first pass: leaves each vertex's mean area in inverse_areas_ and its largest share in largest_shares_. Calls
  /// visit(v, ring, sums) with what adds up.
  template <class Visit>
  MeanRatioSums measure(const Visit& visit) {
    const MeanRatioSums sums = sum_over_rings([&](std::int32_t v, const auto& ring, MeanRatioSums& own) {
      const MeanRatioRing<T> found = measure_for_mean_ratio(points_[v], ring);
      own.add(found.sums);
      inverse_area(v) = found.mean_area;
      share(v) = found.largest_share;
      visit(v, ring, own);
    });
    return halo_ == nullptr ? sums : of_all_parts(*halo_, sums);
  }

  HostTargets& targets_;
  std::span<const Point2<T>> points_;
  const PackedRings& rings_;
  RingView view_;
  Workers& workers_;
  Halo* halo_;
};

template <class T>
HostTargets<T>::HostTargets(std::span<const Point2<T>> points, const PackedRings& rings,
                            const MeanRatioOptions& options, Workers& workers, std::span<const double> inverse_sizes,
                            Halo* halo)
    : inverse_areas_(points.size()), largest_shares_(static_cast<std::size_t>(rings.free_count())) {
  Finder finder(*this, points, rings, workers, halo);
  if (inverse_sizes.empty()) {
    finder.aim_at_input(options);
  } else {
    finder.aim_at_sizes(options, inverse_sizes);
  }
  if (options.target == TargetShape::input) {
    finder.find_edges();
  }
}

template <class T>
void HostTargets<T>::scale_by(int exponents) {
  for (T& inverse : inverse_areas_) {
    inverse = inverse_area_in(inverse, exponents);
  }
  for (T& share : largest_shares_) {
    share = largest_share_in(share, exponents);
  }
  mesh_.mean_area = std::ldexp(mesh_.mean_area, -2 * exponents);
}

template <class T>
HostTargets<T> HostTargets<T>::moved(std::span<const Point2<T>> reference, std::span<const Point2<T>> points,
                                     int exponents, const PackedRings& rings, Workers& workers, Halo* halo) const {
  HostTargets moved = *this;
  Finder(moved, points, rings, workers, halo).move_from(reference, exponents);
  return moved;
}

template class HostTargets<float>;
template class HostTargets<double>;

}  // namespace trismooth
