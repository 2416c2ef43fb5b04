// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/methods/methods.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"
#include "trismooth/smoothing/sweeps/host_targets.h"
#include "trismooth/smoothing/sweeps/mean_ratio_lanes.h"
#include "trismooth/smoothing/sweeps/proposed_update.h"
#include "trismooth/smoothing/sweeps/slide_pass.h"
#include "trismooth/smoothing/sweeps/stop_rule.h"
#include "trismooth/smoothing/sweeps/sweep_control.h"
#include "trismooth/smoothing/sweeps/sweep_offload.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"
#include "trismooth/smoothing/sweeps/vertex_list.h"
#include "trismooth/smoothing/sweeps/vertex_visits.h"

namespace trismooth {

/// Runs sweeps in working precision T over packed points, to a stop. Form A writes into a second buffer and swaps;
/// Form B writes in place, batch by batch.
///
/// A vertex is evaluated only where it is marked, and it is marked when it or one of its neighbours moves. The others
/// would stay where they are: an update depends on a vertex and its neighbours alone, and if none of them has changed
/// since the last evaluation, then the last answer was "stay", for a move would have changed the vertex itself.
template <class T>
class SweepDriver {
 public:
  /// `inverse_sizes`: see HostTargets. `slide`: what slides, where slides_behind() says so; null: nothing. `halo`: of a
  /// part of a mesh, whose other parts run sweeps at the same time; null: it is the whole. `offload`: who makes the
  /// sweeps of a part, in place of this thread and its workers; null: nobody. `proposed`: the method of the caller's
  /// own; null: that of the options. `reference`: the mesh that Method::mean_ratio aims at; null: that of the points.
  SweepDriver(const PackedRings& rings, const SmoothingOptions& options, Workers& workers,
              std::span<const double> inverse_sizes = {}, SlidePass<T>* slide = nullptr, Halo* halo = nullptr,
              SweepOffload<T>* offload = nullptr, const ProposedUpdate<T>* proposed = nullptr,
              const ReferenceTargets<T>* reference = nullptr)
      : rings_(rings),
        view_(rings.view()),
        options_(options),
        workers_(workers),
        inverse_sizes_(inverse_sizes),
        slide_(slide),
        halo_(halo),
        offload_(offload),
        proposed_(proposed),
        reference_(reference) {}

  /// Smooths `points` (packed, local frame) and fills the counters, the history and the stop reason of `result`.
  /// `fixed_quotient` is the smallest shape quotient among the triangles without a free vertex.
  void run(BulkVector<Point2<T>>& points, double fixed_quotient, SmoothingResult& result);

 private:
  static constexpr std::int64_t grain = 1024;

  void run_stages(BulkVector<Point2<T>>& points, double fixed_quotient, SmoothingResult& result) {
    if (options_.form == Form::swap && offload_ == nullptr) {
      other_points_ = points;
    }
    if (reached_target(points, fixed_quotient)) {
      result.stop_reason = StopReason::quality_target;
      return;
    }
    // (Parts say it together, behind this.)
    if (const auto end = halo_ == nullptr ? SweepControl::end_before_sweeps(options_) : std::nullopt) {
      result.stop_reason = stop_reason(*end);
      return;
    }
    const HostTargets<T> targets = targets_from(points);
    if (slide_ != nullptr && options_.method == Method::mean_ratio) {
      slide_->aim(points, targets.view(), targets.mesh(), !inverse_sizes_.empty());
    }
    SweepControl control(options_, halo_ == nullptr ? rings_.free_count() : halo_->part().free_vertices, result, halo_);
    if (control.is_over()) {
      return;
    }
    if (offload_ != nullptr) {
      offload_->begin(points, targets.view());
    }
    bool is_over = false;
    while (!is_over) {
      const MethodInUse<T> in_use{options_.method, targets.view(), control.stages().template step<T>()};
      is_over = run_stage(in_use, points, control, fixed_quotient);
    }
    if (offload_ != nullptr) {
      offload_->end(points);
    }
  }

  HostTargets<T> targets_from(std::span<const Point2<T>> points) const {
    if (options_.method != Method::mean_ratio) {
      return {};
    }
    return reference_ != nullptr
               ? reference_->targets.moved(reference_->points, points, reference_->exponents, rings_, workers_, halo_)
               : HostTargets<T>(points, rings_, options_.mean_ratio, workers_, inverse_sizes_, halo_);
  }

  /// Sweeps to the end of the stage; true where it is that of the run.
  bool run_stage(const MethodInUse<T>& in_use, BulkVector<Point2<T>>& points, SweepControl& control,
                 double fixed_quotient) {
    const bool swaps = options_.form == Form::swap;
    if (offload_ != nullptr) {
      offload_->begin_stage();
    } else {
      marked_.assign(points.size(), 1);
      other_marked_.assign(swaps ? points.size() : 0, 0);
    }
    do {
      SweepTally<T> tally = offload_ != nullptr ? offload_->sweep(in_use.step)
                            : swaps             ? sweep(in_use, points, other_points_, marked_, other_marked_)
                                                : sweep(in_use, points, points, marked_, marked_);
      if (swaps && offload_ == nullptr) {
        points.swap(other_points_);
        marked_.swap(other_marked_);
      }
      double seconds = control.seconds();
      if (halo_ != nullptr) {
        join_parts(tally, seconds);
      }
      if (slide_ != nullptr && control.slides_behind(1, control.settles(tally))) {
        tally.join(slide_->run(in_use, {points, other_points_, marked_, other_marked_,
                                        options_.evaluation == Evaluation::all, static_cast<T>(options_.tolerance)}));
      }
      double shape = no_target;
      if (options_.measures_shape()) {
        shape =
            min_shape(offload_ != nullptr ? offload_->smallest_quotient() : smallest_quotient(points), fixed_quotient);
      }
      if (control.add(tally, shape, halo_ == nullptr ? control.seconds() : seconds)) {
        return true;
      }
    } while (!control.begins_stage());
    return false;
  }

  SweepTally<T> sweep(const MethodInUse<T>& in_use, const BulkVector<Point2<T>>& from, BulkVector<Point2<T>>& to,
                      std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& marked_next) {
    SweepTally<T> total;
    std::mutex joining;
    for (std::size_t batch = 0; batch + 1 < rings_.batches.size(); ++batch) {
      const std::int32_t first = rings_.batches[batch];
      workers_.for_blocks(rings_.batches[batch + 1] - first, grain, [&](std::int64_t begin, std::int64_t end) {
        SweepTally<T> tally;
        const auto update = [&](const auto& method) {
          update_block(method, first + static_cast<std::int32_t>(begin), first + static_cast<std::int32_t>(end), from,
                       to, marked, marked_next, tally);
        };
        proposed_ != nullptr ? update(*proposed_) : visit_method(in_use, update);
        const std::lock_guard lock(joining);
        total.join(tally);
      });
      if (halo_ != nullptr) {
        exchange(static_cast<std::int32_t>(batch), from, to, marked_next);
      }
    }
    return total;
  }

  /// Of two batches the first is what other parts wait for: it is on its way to them while the second one is done.
  void exchange(std::int32_t batch, std::span<const Point2<T>> from, std::span<Point2<T>> to,
                std::span<std::uint8_t> marked_next) {
    const std::int32_t colour = batch / 2;
    if (batch % 2 == 0) {
      halo_->start(colour, std::span<const Point2<T>>(to));
      return;
    }
    halo_->finish<Point2<T>>(colour, [&](std::int32_t ghost, const Point2<T>& place) {
      const bool is_elsewhere = !have_same_bits(from[ghost], place);
      to[ghost] = place;
      if (is_elsewhere) {
        for (const std::int32_t v : halo_->around_ghosts()[ghost]) {
          marked_next[v] = 1;
        }
      }
    });
  }

  void join_parts(SweepTally<T>& tally, double& seconds) const {
    PartSums sums;
    sums.sums = {tally.evaluated, tally.moved, tally.within_tolerance ? 0 : 1};
    sums.largest = {static_cast<double>(tally.max_relative_squared), seconds};
    halo_->messenger().join(sums);
    tally.evaluated = sums.sums[0];
    tally.moved = sums.sums[1];
    tally.within_tolerance = sums.sums[2] == 0;
    tally.max_relative_squared = static_cast<T>(sums.largest[0]);
    seconds = sums.largest[1];
  }

  /// Everything in it is inlined, by force: left alone, GCC calls what works on a few numbers in registers.
  template <class Update>
  [[gnu::flatten]] void update_block(const Update& method, std::int32_t begin, std::int32_t end,
                                     std::span<const Point2<T>> from, std::span<Point2<T>> to,
                                     std::span<std::uint8_t> marked, std::span<std::uint8_t> marked_next,
                                     SweepTally<T>& tally) {
    VertexVisits<T, Update> visits(method, view_, from);
    VertexList list(marked, options_.evaluation == Evaluation::all, begin, end);
    const T tolerance = static_cast<T>(options_.tolerance);
    const auto settle = [&](std::int32_t v, Point2<T> target, T squares) {
      const int neighbours = static_cast<int>(view_[v].size());
      add_move(tally, length_of_move(from[v], target, neighbours, squares), tolerance);
      to[v] = target;
      mark_neighbourhood(v, marked_next);
    };
    for (auto vertices = list.next(); !vertices.empty(); vertices = list.next()) {
      tally.evaluated += static_cast<std::int64_t>(vertices.size());
      if (from.data() != to.data()) {
        for (const std::int32_t v : vertices) {
          to[v] = from[v];
        }
      }
      for_runs_of_one_size(rings_.runs, vertices, [&](std::span<const std::int32_t> run, int ring_size, RingKind kind) {
        visits.visit(run, ring_size, kind, settle);
      });
    }
  }

  /// Fixed vertices are marked, too: to ask costs more, and nobody looks there. Threads may mark the same vertex at the
  /// same time, with the same value. A move marks no other vertex of its own batch (Form B) or of this sweep (Form A).
  void mark_neighbourhood(std::int32_t v, std::span<std::uint8_t> marked) const {
    const auto mark = [&](std::int32_t vertex) { std::atomic_ref(marked[vertex]).store(1, std::memory_order_relaxed); };
    mark(v);
    view_.for_vertices_around(v, mark);
  }

  bool reached_target(std::span<const Point2<T>> points, double fixed_quotient) {
    return options_.target_quality && min_shape(smallest_quotient(points), fixed_quotient) >= *options_.target_quality;
  }

  /// The smallest shape of all elements. `smallest`: as smallest_quotient().
  double min_shape(T smallest, double fixed_quotient) const {
    return min_shape_of(least_of_parts(halo_, static_cast<double>(smallest)), fixed_quotient);
  }

  /// The smallest quotient of the triangles of this part, seen from their free vertices.
  T smallest_quotient(std::span<const Point2<T>> points) {
    T smallest = std::numeric_limits<T>::infinity();
    std::mutex joining;
    workers_.for_blocks(rings_.free_count(), grain, [&](std::int64_t begin, std::int64_t end) {
      RingGatherer<T> gatherer;
      T worst = std::numeric_limits<T>::infinity();
      for (auto v = static_cast<std::int32_t>(begin); v < end; ++v) {
        worst = std::min(
            worst, gatherer.visit(points, view_, v, [&](const auto& ring) { return worst_quotient(points[v], ring); }));
      }
      const std::lock_guard lock(joining);
      smallest = std::min(smallest, worst);
    });
    if (slide_ != nullptr) {
      smallest = std::min(smallest, slide_->smallest_quotient(points));
    }
    return smallest;
  }

  const PackedRings& rings_;
  RingView view_;
  const SmoothingOptions& options_;
  Workers& workers_;
  std::span<const double> inverse_sizes_;
  SlidePass<T>* slide_;
  Halo* halo_;
  SweepOffload<T>* offload_;
  const ProposedUpdate<T>* proposed_;
  const ReferenceTargets<T>* reference_;
  BulkVector<Point2<T>> other_points_;
  std::vector<std::uint8_t> marked_;  ///< one a vertex
  std::vector<std::uint8_t> other_marked_;
};

template <class T>
void SweepDriver<T>::run(BulkVector<Point2<T>>& points, double fixed_quotient, SmoothingResult& result) {
  workers_.run([&] { run_stages(points, fixed_quotient, result); });
}

// Each has a source of its own, which takes long to compile.
extern template class SweepDriver<float>;
extern template class SweepDriver<double>;

}  // namespace trismooth
