// SPDX-License-Identifier: BSD-3-Clause
#include <type_traits>

#include "trismooth/cuda/primitives/vertex_marks.cuh"
#include "trismooth/cuda/runtime/dependent_launch.cuh"
#include "trismooth/cuda/runtime/for_each.cuh"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/cuda/slide/slide_pass.h"
#include "trismooth/cuda/sweeps/block_tally.cuh"
#include "trismooth/smoothing/slide/slide_targets.h"

namespace trismooth::cuda {

namespace {

/// Threads of a team, which look at the elements of a slider, one each. What counts is how soon one slider is done: so
/// it has a warp of its own, and does not wait for the branches of others.
constexpr int team_size = 32;
/// Few in a block: a line has few vertices, and each takes long.
constexpr unsigned slide_threads = 64;

/// Positions in double.
template <class T>
struct WidePoints {
  PointArray<T> points;

  __device__ Point2<double> operator()(std::int32_t v) const {
    const Point2<T> point = points.load(v);
    return {static_cast<double>(point.x), static_cast<double>(point.y)};
  }
};

/// What another thread of the team has. All threads of the team call it.
template <class Value>
__device__ Value from_lane(const Value& own, int lane) {
  static_assert(std::is_trivially_copyable_v<Value>);
  constexpr std::size_t count = (sizeof(Value) + sizeof(unsigned) - 1) / sizeof(unsigned);
  unsigned words[count] = {};
  memcpy(words, &own, sizeof(Value));
  for (unsigned& word : words) {
    word = __shfl_sync(0xFFFFFFFFU, word, lane);
  }
  Value found;
  memcpy(&found, words, sizeof(Value));
  return found;
}

/// See SlideAlone.
struct SlideTeam {
  int lane = static_cast<int>(threadIdx.x % team_size);  ///< of the thread

  __device__ bool is_first() const { return lane == 0; }

  template <class Find, class Take>
  __device__ void for_each(std::int32_t begin, std::int32_t end, const Find& find, const Take& take) const {
    for (std::int32_t first = begin; first < end; first += team_size) {
      const int count = min(team_size, end - first);
      const auto mine = find(first + min(lane, count - 1));
      for (int k = 0; k < count; ++k) {
        take(from_lane(mine, k));
      }
    }
  }
};

/// Writes down where a slider is now, and marks who is to look at it.
template <class T>
__device__ void settle(const SlideWork<T>& work, const SlideTeam& team, bool is_first, const Slider& slider,
                       const ChainCurve& curve, const SlidePlace& place) {
  const SlideChain& chain = curve.chain();
  std::uint32_t* const marks = is_first ? work.first_marks : work.second_marks;
  const auto mark_free = [&](std::int32_t v) {
    if (marks != nullptr && v < work.free_count) {
      mark(marks, v);
    }
  };
  for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
    if (team.is_first()) {
      const std::int32_t v = work.view.vertices[slider.knot + copy * chain.count];
      const Point2<T> point = working_point<T>(curve.position(place, copy));
      work.first.store(v, point);
      work.second.store(v, point);
    }
    const std::int32_t fan = work.view.fan_at[slider.knot + copy * chain.count];
    for (std::int32_t i = work.view.fans[fan] + team.lane; i < work.view.fans[fan + 1]; i += team_size) {
      work.view.sides[i].for_each(mark_free);
    }
  }
  if (team.is_first()) {
    work.places[slider.knot] = place;
  }
}

template <class Update, class T>
__global__ void __launch_bounds__(slide_threads)
    slide_batch(Update method, SlideWork<T> work, std::int32_t begin, std::int32_t end, std::int32_t due_after,
                const LoopState* state, SweepSums* sums) {
  wait_for_launch_before();
  const std::int32_t sweeps = state->sweeps;
  if (sweeps == 0 || (state->stop == LoopState::running && sweeps != due_after)) {
    return;
  }
  __shared__ SweepSums shared;
  SweepTally<T> tally;
  const SlideTeam team;
  const std::int64_t s = begin + thread_index() / team_size;
  if (s < end) {
    const bool is_first = state->current == 0;
    const Slider slider = work.view.sliders[s];
    const WidePoints<T> points{is_first ? work.first : work.second};
    const SlidingVertex vertex(work.view, work.places, slider, points, team);
    const SlideMove move = slide(method, vertex, work.targets == nullptr ? FanTarget{} : work.targets[s]);
    // (No thread of the team has anything left to read that others write.)
    __syncwarp();
    if (move.moved) {
      settle(work, team, is_first, slider, vertex.curve(), move.place);
    }
    if (team.is_first()) {
      ++tally.evaluated;
      if (move.moved) {
        add_move(tally, MoveLength<T>{static_cast<T>(move.moved_squares), static_cast<T>(move.squares)},
                 work.tolerance);
      }
    }
  }
  add_to_sums(tally, shared, sums + (sweeps - 1));
}

/// Positions in the local frame as the sweeps begin with them.
template <class T>
struct EnteredPoints {
  const Point2<double>* points;

  __device__ Point2<double> operator()(std::int32_t v) const {
    const Point2<T> point = working_point<T>(points[v]);
    return {static_cast<double>(point.x), static_cast<double>(point.y)};
  }
};

template <class T>
struct FindFanTargets {
  SlideView view;
  SlidePlaces places;
  EnteredPoints<T> points;
  MeshAims aims;
  const T* inverse_areas;
  FanTarget* targets;

  __device__ void operator()(std::uint32_t s) const {
    const Slider slider = view.sliders[s];
    const MeanRatioMesh mesh = MeanRatioMesh::of(*aims.sums, aims.size_weight, aims.power, aims.has_sizes);
    const double asked = aims.has_sizes ? static_cast<double>(inverse_areas[view.vertices[slider.knot]]) : 0.0;
    targets[s] = fan_target(SlidingVertex(view, places, slider, points), mesh, asked);
  }
};

}  // namespace

template <class T>
std::int64_t launch_slide_pass(const MethodInUse<T>& method, const SlideWork<T>& work,
                               std::span<const std::int32_t> batches, std::int32_t due_after, const LoopState* state,
                               SweepSums* sums, cudaStream_t stream) {
  visit_method(method, [&]<class Update>(const Update& update) {
    DependentLaunch kernel(&slide_batch<Update, T>, stream);
    for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
      const std::int64_t threads = std::int64_t{team_size} * (batches[batch + 1] - batches[batch]);
      kernel(blocks_for(threads, slide_threads), slide_threads, update, work, batches[batch], batches[batch + 1],
             due_after, state, sums);
    }
  });
  return std::ssize(batches) - 1;
}

template <class T>
void launch_fan_targets(const Context& context, const SlideView& view, SlidePlaces places, const Point2<double>* before,
                        std::int32_t slider_count, const MeshAims& aims, const T* inverse_areas, FanTarget* targets) {
  for_each(context, static_cast<std::uint32_t>(slider_count),
           FindFanTargets<T>{view, places, {before}, aims, inverse_areas, targets});
}

#define INSTANTIATE(T)                                                                                                 \
  template std::int64_t launch_slide_pass(const MethodInUse<T>&, const SlideWork<T>&, std::span<const std::int32_t>,   \
                                          std::int32_t, const LoopState*, SweepSums*, cudaStream_t);                   \
  template void launch_fan_targets(const Context&, const SlideView&, SlidePlaces, const Point2<double>*, std::int32_t, \
                                   const MeshAims&, const T*, FanTarget*)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda
