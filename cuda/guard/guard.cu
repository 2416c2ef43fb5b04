// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "trismooth/cuda/guard/guard.h"
#include "trismooth/cuda/guard/guard_view.cuh"
#include "trismooth/cuda/packing/ring_views.h"
#include "trismooth/cuda/primitives/atomics.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/primitives/falling_key.h"
#include "trismooth/cuda/primitives/grid_barrier.cuh"
#include "trismooth/cuda/primitives/largest_key.cuh"
#include "trismooth/cuda/runtime/device_properties.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/runtime/thread_index.cuh"
#include "trismooth/smoothing/guard/guard_rule.h"

namespace trismooth::cuda {

namespace {

__device__ void raise(unsigned long long* word, unsigned long long key) {
  // Most blocks have nothing to add.
  if (key > *static_cast<volatile unsigned long long*>(word)) {
    atomicMax(word, key);
  }
}

/// Keys of the elements of moved vertices that a thread looks at.
class KeyTally {
 public:
  template <class Corner>
  __device__ void operator()(const JudgedElement<Corner>& element) {
    if (element.moved()) {
      const Quotients found = quotients(element);
      const double worsened = worsened_quotient(found.before, found.after);
      before_ = found.before < before_ ? found.before : before_;
      worsened_ = worsened < worsened_ ? worsened : worsened_;
    }
  }
  __device__ GuardKeys keys() const { return {falling_key(before_), falling_key(worsened_)}; }

 private:
  double before_ = std::numeric_limits<double>::infinity();
  double worsened_ = std::numeric_limits<double>::infinity();
};

/// Looks at every element of a moved vertex once: at the corner with the smallest packed number, which is a free vertex
/// if any is, as these are numbered first. The keys of the block say later whether to look at its elements again.
template <class View>
__global__ void __launch_bounds__(block_size, 4) judge(View view, GuardKeys* keys, GuardState* state) {
  if (!view.run_is_over()) {
    return;
  }
  __shared__ GuardKeys shared;
  if (threadIdx.x == 0) {
    shared = {};
  }
  __syncthreads();
  KeyTally tally;
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i < static_cast<std::uint32_t>(view.rings.size)) {
    const Positions<View> positions(view);
    const auto v = static_cast<std::int32_t>(i);
    for_elements(view, positions, v, v, tally);
  }
  const GuardKeys own = tally.keys();
  join_largest(&shared.before, own.before);
  join_largest(&shared.worsened, own.worsened);
  __syncthreads();
  if (threadIdx.x == 0) {
    keys[blockIdx.x] = shared;
    raise(&state->all.before, shared.before);
    raise(&state->all.worsened, shared.worsened);
  }
}

/// The buffers, for kernels.
struct GuardWork {
  GuardKeys* keys;
  std::uint32_t* marks;
  Offender* list;
  std::uint32_t list_size;
};

/// Barriers of all blocks as often as one likes, with three words: when all have arrived at a barrier, nobody waits at
/// the one before it any more, whose word is then cleared for the one after the next.
class RepeatedBarrier {
 public:
  __device__ explicit RepeatedBarrier(BarrierWord* words) : words_(words) {}

  /// All threads of the grid call it.
  __device__ void wait() {
    __shared__ unsigned long long total;
    const unsigned following = next_ == 2 ? 0 : next_ + 1;
    if (thread_index() == 0) {
      words_[following] = 0;
    }
    grid_barrier(&words_[next_], 0, total, [] {});
    next_ = following;
  }

 private:
  BarrierWord* words_;
  unsigned next_ = 0;
};

/// Marks and lists the moved corners of elements that offend, each once.
class OffenderSearch {
 public:
  __device__ OffenderSearch(const GuardWork& work, unsigned long long threshold, std::uint32_t* listed)
      : work_(work), threshold_(from_falling_key(threshold)), listed_(listed) {}

  template <class Corner>
  __device__ void operator()(const JudgedElement<Corner>& element) const {
    if (!element.moved()) {
      return;
    }
    if (const Quotients found = quotients(element); offends(found.before, found.after, threshold_)) {
      element.for_each([&](const JudgedVertex& corner) { add(corner); });
    }
  }

 private:
  __device__ void add(const JudgedVertex& corner) const {
    const std::uint32_t bit = 1U << (corner.vertex % 32);
    if (!corner.moved() || (atomicOr(&work_.marks[corner.vertex / 32], bit) & bit) != 0) {
      return;
    }
    // What there is no room for is counted still.
    if (const std::uint32_t place = atomicAdd(listed_, 1U); place < work_.list_size) {
      work_.list[place].vertex = corner.vertex;
    }
  }

  const GuardWork& work_;
  double threshold_;
  std::uint32_t* listed_;
};

/// Threads of a block that makes rounds, one on each multiprocessor.
constexpr unsigned round_threads = 1024;
constexpr unsigned warp_size = 32;

/// The rounds that take offenders back, until there are none or more than the list holds. All blocks of threads are on
/// the device at the same time. Each warp looks after some blocks of vertices. A round reads the keys of every block,
/// but looks at elements only where vertices have gone back or something offends.
template <class View>
class Rounds {
 public:
  __device__ Rounds(const View& view, const GuardWork& work, GuardState* state)
      : view_(view),
        work_(work),
        state_(state),
        positions_(view),
        barrier_(state->barriers),
        threads_(static_cast<std::int64_t>(gridDim.x) * round_threads),
        blocks_((view.rings.size + std::int64_t{block_size} - 1) / block_size) {}

  __device__ void run() {
    std::uint32_t taken_back = 0;
    std::uint32_t rounds = 0;
    std::uint32_t listed = 0;
    unsigned long long last_threshold = 0;
    for (;; ++rounds) {
      last_threshold = find_threshold(rounds % 3);
      search(last_threshold);
      barrier_.wait();
      listed = load_relaxed(&state_->listed);
      if (listed == taken_back || listed > work_.list_size) {
        break;
      }
      take_back(taken_back, listed);
      taken_back = listed;
      barrier_.wait();
    }
    if (thread_index() == 0) {
      state_->taken_back = taken_back;
      state_->rounds += rounds;
      state_->settled = listed == taken_back ? 1 : 0;
      state_->last_threshold = last_threshold;
    }
  }

 private:
  /// Calls body(block, lane) for the blocks of vertices of this warp.
  template <class Body>
  __device__ void for_blocks(const Body& body) const {
    const auto lane = static_cast<std::int32_t>(threadIdx.x % warp_size);
    for (std::int64_t block = thread_index() / warp_size; block < blocks_; block += threads_ / warp_size) {
      body(block, lane);
    }
  }

  /// The elements of a block, by a warp.
  template <class Visit>
  __device__ void for_elements_of(std::int64_t block, std::int32_t lane, Visit& visit) const {
    const std::int64_t end = min(static_cast<std::int64_t>(view_.rings.size), (block + 1) * block_size);
    for (std::int64_t v = block * block_size + lane; v < end; v += warp_size) {
      for_elements(view_, positions_, static_cast<std::int32_t>(v), static_cast<std::int32_t>(v), visit);
    }
  }

  /// Brings the keys up to date, and the key of T with them, in the word of this round.
  __device__ unsigned long long find_threshold(std::uint32_t word) {
    unsigned long long largest = 0;
    for_blocks([&](std::int64_t block, std::int32_t lane) {
      unsigned long long before = work_.keys[block].before;
      if (before == GuardKeys::outdated) {
        KeyTally tally;
        for_elements_of(block, lane, tally);
        const GuardKeys own = tally.keys();
        before = largest_of_warp(own.before);
        const unsigned long long worsened = largest_of_warp(own.worsened);
        if (lane == 0) {
          work_.keys[block] = {before, worsened};
        }
      }
      largest = before > largest ? before : largest;
    });
    if (threadIdx.x % warp_size == 0) {
      raise(&state_->thresholds[word], largest);
    }
    if (thread_index() == 0) {
      state_->thresholds[word == 2 ? 0 : word + 1] = 0;
    }
    barrier_.wait();
    return *static_cast<volatile unsigned long long*>(&state_->thresholds[word]);
  }

  /// Lists the moved corners of elements that offend.
  __device__ void search(unsigned long long threshold) const {
    OffenderSearch offenders(work_, threshold, &state_->listed);
    for_blocks([&](std::int64_t block, std::int32_t lane) {
      if (work_.keys[block].worsened > threshold) {
        for_elements_of(block, lane, offenders);
      }
    });
  }

  /// Puts back what has been listed since the last round. The keys of blocks that may hold one of its elements are
  /// outdated: a vertex and those around it are the corners that elements may be looked at from.
  __device__ void take_back(std::uint32_t begin, std::uint32_t end) const {
    for (std::int64_t i = begin + thread_index(); i < end; i += threads_) {
      const std::int32_t v = work_.list[i].vertex;
      work_.list[i] = {v, view_.input_index[v], positions_.stored(v)};
      positions_.take_back(v);
      work_.marks[v / 32] = 0;  // all marks are of vertices that go back
      judge_again(v);
      if (v < view_.rings.size) {
        const std::int32_t size = view_.rings.ring_size(v);
        const auto ring = view_.rings.ring(v);
        for_vertices_around(ring, size, [&](std::int32_t other) { judge_again(other); });
      } else {
        const std::int32_t fan = view_.held.fan_of[v - view_.rings.size];
        for (std::int32_t k = view_.held.fans[fan]; k < view_.held.fans[fan + 1]; ++k) {
          view_.held.sides[k].for_each([&](std::int32_t other) { judge_again(other); });
        }
      }
    }
  }

  __device__ void judge_again(std::int32_t v) const {
    if (v < view_.rings.size) {
      work_.keys[v / block_size].before = GuardKeys::outdated;
    }
  }

  const View& view_;
  const GuardWork& work_;
  GuardState* state_;
  Positions<View> positions_;
  RepeatedBarrier barrier_;
  std::int64_t threads_;
  std::int64_t blocks_;
};

template <class View>
__global__ void __launch_bounds__(round_threads, 1) make_rounds(View view, GuardWork work, GuardState* state) {
  if (view.run_is_over() && !state->nothing_offends() && view.held.has_good_lines()) {
    Rounds<View>(view, work, state).run();
  }
}

/// Whether nothing offends any more, or, with vertices that are held to lines, nothing has offended.
__device__ bool may_write(const HeldView& held, const GuardState& state) {
  if (held.after == nullptr) {
    return state.may_write();
  }
  return held.lines != nullptr && state.nothing_offends() && held.lines->is_good(state.all.before);
}

/// Writes the vertices that are elsewhere; if `guarded`, only where nobody has to go back.
template <class View>
__global__ void __launch_bounds__(block_size) write_moved(View view, bool guarded, double2* stored, GuardState* state) {
  if (!view.run_is_over() || !view.held.has_good_lines() || (guarded && !may_write(view.held, *state))) {
    return;
  }
  bool moved = false;
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i < static_cast<std::uint32_t>(view.rings.size)) {
    const Positions<View> positions(view);
    const auto v = static_cast<std::int32_t>(i);
    const Point2<double> before = positions.before(v);
    moved = !(positions.after(v, before) == before);
    if (moved) {
      const Point2<double> position = positions.stored(v);
      stored[view.input_index[v]] = {position.x, position.y};
    }
  }
  const int found = __syncthreads_count(moved ? 1 : 0);
  if (threadIdx.x == 0 && found > 0) {
    atomicAdd(&state->moved, static_cast<std::uint32_t>(found));
  }
}

/// Queues the rounds of the guard, and the writing. Returns the number of launches.
template <class View>
std::int64_t launch_rounds(const View& view, GuardBuffers& buffers, Point2<double>* stored, GuardState* state,
                           cudaStream_t stream) {
  if (buffers.guards()) {
    View view_argument = view;
    GuardWork work{buffers.keys.data(), buffers.marks.data(), buffers.list.data(),
                   static_cast<std::uint32_t>(buffers.list.size())};
    void* arguments[] = {&view_argument, &work, &state};
    const auto blocks =
        std::min(blocks_for(view.rings.size, round_threads), static_cast<unsigned>(multiprocessor_count()));
    TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(&make_rounds<View>), dim3(blocks),
                                                     dim3(round_threads), arguments, 0, stream));
  }
  write_moved<<<blocks_for(view.rings.size), block_size, 0, stream>>>(view, buffers.guards(),
                                                                      reinterpret_cast<double2*>(stored), state);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  return buffers.guards() ? 2 : 1;
}

/// Adds the first `count` of the list.
void collect(const DeviceBuffer<Offender>& list, std::uint32_t count, std::int32_t free_count,
             DeviceGuardOutcome& outcome) {
  std::vector<Offender> offenders(count);
  list.download(offenders);
  for (const Offender& offender : offenders) {
    if (offender.vertex < free_count) {
      outcome.reverted.push_back({offender.input, offender.position});
    } else {
      outcome.held.push_back(offender.vertex);
    }
  }
}

}  // namespace

GuardBuffers::GuardBuffers(Context& context, std::int32_t free_count, std::int32_t movable)
    : keys(context, blocks_for(free_count)),
      marks(context, (static_cast<std::size_t>(movable) + 31) / 32),
      list(context, static_cast<std::size_t>(list_size(free_count))) {
  marks.fill_bytes(0);
}

template <class T, class Rings>
std::int64_t launch_guard(const Rings& rings, const GuardInput<T>& input, GuardBuffers& buffers, Point2<double>* stored,
                          GuardState* state, cudaStream_t stream) {
  const GuardView<T, Rings> view{input, rings};
  std::int64_t launches = 0;
  if (buffers.guards()) {
    judge<<<blocks_for(rings.size), block_size, 0, stream>>>(view, buffers.keys.data(), state);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    ++launches;
  }
  return launches + launch_rounds(view, buffers, stored, state, stream);
}

template <class T, class Rings>
void launch_writing(const Rings& rings, const GuardInput<T>& input, Point2<double>* stored, GuardState* state,
                    cudaStream_t stream) {
  constexpr bool guarded = false;
  write_moved<<<blocks_for(rings.size), block_size, 0, stream>>>(GuardView<T, Rings>{input, rings}, guarded,
                                                                 reinterpret_cast<double2*>(stored), state);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

template <class T, class Rings>
DeviceGuardOutcome finish_guard(Context& context, const Rings& rings, const GuardInput<T>& input, GuardBuffers& buffers,
                                Point2<double>* stored, GuardState* state, GuardState found, std::int64_t& launches) {
  DeviceGuardOutcome outcome;
  collect(buffers.list, found.taken_back, rings.size, outcome);
  while (!found.may_write()) {
    // The round that did not fit is found once more, among all elements: those of vertices that went back have changed
    // since they were judged.
    buffers.marks.fill_bytes(0);
    buffers.keys.fill_bytes(0xFF);  // outdated
    if (const std::size_t round_size = found.listed - found.taken_back; round_size > buffers.list.size()) {
      buffers.list = DeviceBuffer<Offender>(context, std::min(2 * round_size, 32 * buffers.marks.size()));
    }
    found.listed = 0;
    std::ranges::fill(found.barriers, 0ULL);
    std::ranges::fill(found.thresholds, 0ULL);
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(state, &found, sizeof(found), cudaMemcpyHostToDevice, context.stream()));
    launches += launch_rounds(GuardView<T, Rings>{input, rings}, buffers, stored, state, context.stream());
    found = download(context, state);
    collect(buffers.list, found.taken_back, rings.size, outcome);
  }
  std::ranges::sort(outcome.reverted, {}, &RevertedVertex::vertex);
  outcome.rounds = found.rounds;
  outcome.moved = found.moved;
  outcome.threshold = from_falling_key(found.nothing_offends() ? found.all.before : found.last_threshold);
  return outcome;
}

#define INSTANTIATE(T, Rings)                                                                                         \
  template std::int64_t launch_guard(const Rings&, const GuardInput<T>&, GuardBuffers&, Point2<double>*, GuardState*, \
                                     cudaStream_t);                                                                   \
  template void launch_writing(const Rings&, const GuardInput<T>&, Point2<double>*, GuardState*, cudaStream_t);       \
  template DeviceGuardOutcome finish_guard(Context&, const Rings&, const GuardInput<T>&, GuardBuffers&,               \
                                           Point2<double>*, GuardState*, GuardState, std::int64_t&)
TRISMOOTH_WITH_RING_VIEWS(INSTANTIATE, float);
TRISMOOTH_WITH_RING_VIEWS(INSTANTIATE, double);

}  // namespace trismooth::cuda
