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

template <class T>
__device__ void settle(const SlideWork<T>& work, bool is_first, const Slider& slider, const ChainCurve& curve,
                       const SlideMove& move) {
  const SlideChain& chain = curve.chain();
  std::uint32_t* const marks = is_first ? work.first_marks : work.second_marks;
  const auto mark_free = [&](std::int32_t v) {
    if (marks != nullptr && v < work.free_count) {
      mark(marks, v);
    }
  };
  for (std::int32_t copy = 0; copy < chain.copies; ++copy) {
    const std::int32_t v = work.view.vertices[slider.knot + copy * chain.count];
    const Point2<T> place = working_point<T>(curve.position(move.place, copy));
    work.first.store(v, place);
    work.second.store(v, place);
    const std::int32_t fan = slider.fan + copy;
    for (std::int32_t i = work.view.fans[fan]; i < work.view.fans[fan + 1]; ++i) {
      mark_free(work.view.sides[i].from);
      mark_free(work.view.sides[i].to);
    }
  }
  work.places[slider.knot] = move.place;
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
  const std::int64_t s = begin + thread_index();
  if (s < end) {
    ++tally.evaluated;
    const bool is_first = state->current == 0;
    const Slider slider = work.view.sliders[s];
    const WidePoints<T> points{is_first ? work.first : work.second};
    const SlidingVertex vertex(work.view, work.places, slider, points);
    const SlideMove move = slide(method, vertex, work.targets == nullptr ? FanTarget{} : work.targets[s]);
    if (move.moved) {
      const Point2<double> way = vertex.curve().position(move.place, 0) - vertex.curve().position(vertex.own(), 0);
      const MoveLength<T> length{static_cast<T>(squared_length(way) * move.neighbours), static_cast<T>(move.squares)};
      add_move(tally, length, work.tolerance);
      settle(work, is_first, slider, vertex.curve(), move);
    }
  }
  add_to_sums(tally, shared, sums + (sweeps - 1));
}

template <class T>
struct FindFanTargets {
  SlideWork<T> work;
  MeshAims aims;
  const T* inverse_areas;
  FanTarget* targets;

  __device__ void operator()(std::uint32_t s) const {
    const Slider slider = work.view.sliders[s];
    const WidePoints<T> points{work.first};
    const MeanRatioMesh mesh = MeanRatioMesh::of(*aims.sums, aims.size_weight, aims.power, aims.has_sizes);
    const double asked = aims.has_sizes ? static_cast<double>(inverse_areas[work.view.vertices[slider.knot]]) : 0.0;
    targets[s] = fan_target(SlidingVertex(work.view, work.places, slider, points), mesh, asked);
  }
};

}  // namespace

template <class T>
std::int64_t launch_slide_pass(const MethodInUse<T>& method, const SlideWork<T>& work,
                               std::span<const std::int32_t> batches, std::int32_t due_after, const LoopState* state,
                               SweepSums* sums, cudaStream_t stream) {
  std::int64_t launches = 0;
  visit_method(method, [&]<class Update>(const Update& update) {
    DependentLaunch kernel(&slide_batch<Update, T>, stream);
    for (std::size_t batch = 0; batch + 1 < batches.size(); ++batch) {
      kernel(blocks_for(batches[batch + 1] - batches[batch], slide_threads), slide_threads, update, work,
             batches[batch], batches[batch + 1], due_after, state, sums);
      ++launches;
    }
  });
  return launches;
}

template <class T>
void launch_fan_targets(const Context& context, const SlideWork<T>& work, std::int32_t slider_count,
                        const MeshAims& aims, const T* inverse_areas, FanTarget* targets) {
  for_each(context, static_cast<std::uint32_t>(slider_count), FindFanTargets<T>{work, aims, inverse_areas, targets});
}

#define INSTANTIATE(T)                                                                                               \
  template std::int64_t launch_slide_pass(const MethodInUse<T>&, const SlideWork<T>&, std::span<const std::int32_t>, \
                                          std::int32_t, const LoopState*, SweepSums*, cudaStream_t);                 \
  template void launch_fan_targets(const Context&, const SlideWork<T>&, std::int32_t, const MeshAims&, const T*,     \
                                   FanTarget*)
INSTANTIATE(float);
INSTANTIATE(double);

}  // namespace trismooth::cuda
