#include <algorithm>
#include <cstring>
#include <limits>

#include "trismooth/cuda/atomics.h"
#include "trismooth/cuda/commit.h"
#include "trismooth/cuda/commit_view.cuh"
#include "trismooth/cuda/device_algorithms.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/grid_barrier.cuh"
#include "trismooth/cuda/largest_key.cuh"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/thread_index.cuh"
#include "trismooth/smoothing/guard_rule.h"

namespace trismooth::cuda {

namespace {

__device__ void raise(unsigned long long* word, unsigned long long key) {
  // Most blocks have nothing to add.
  if (key > *static_cast<volatile unsigned long long*>(word)) {
    atomicMax(word, key);
  }
}

/// Judges every element of a moved vertex once: at the corner with the smallest packed number, which is a free vertex
/// if any is, as these are numbered first. The block's verdict says later whether to look at its elements again.
template <class View>
__global__ void __launch_bounds__(block_size, 4) judge(View view, unsigned long long* verdicts, CommitState* state) {
  if (!view.run_is_over()) {
    return;
  }
  __shared__ unsigned long long keys[2];
  if (threadIdx.x < 2) {
    keys[threadIdx.x] = 0;
  }
  __syncthreads();
  Quotients smallest{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  bool spoilt = false;
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i < static_cast<std::uint32_t>(view.rings.size)) {
    const Positions<View> positions(view);
    const auto v = static_cast<std::int32_t>(i);
    for_elements(view, positions, v, v, [&](const Corner& own, const Corner& b, const Corner& c) {
      if (own.moved() || b.moved() || c.moved()) {
        const Quotients found = quotients(own, b, c);
        smallest.before = found.before < smallest.before ? found.before : smallest.before;
        smallest.after = found.after < smallest.after ? found.after : smallest.after;
        spoilt = spoilt || (found.before > 0 && !(found.after > 0)) || !(found.after - found.after == 0);
      }
    });
  }
  join_largest(&keys[0], falling_key(smallest.before));
  join_largest(&keys[1], spoilt ? CommitState::spoilt : falling_key(smallest.after));
  __syncthreads();
  if (threadIdx.x == 0) {
    verdicts[blockIdx.x] = keys[1];
    raise(&state->before, keys[0]);
    raise(&state->after, keys[1]);
  }
}

/// The buffers of a guarded commit, for kernels.
struct Work {
  unsigned long long* verdicts;
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
  __device__ OffenderSearch(const Work& work, unsigned long long before, std::uint32_t* listed)
      : work_(work), threshold_(from_falling_key(before)), listed_(listed) {}

  __device__ void operator()(const Corner& a, const Corner& b, const Corner& c) const {
    if (!a.moved() && !b.moved() && !c.moved()) {
      return;
    }
    if (const Quotients found = quotients(a, b, c); offends(found.before, found.after, threshold_)) {
      add(a);
      add(b);
      add(c);
    }
  }

 private:
  __device__ void add(const Corner& corner) const {
    const std::uint32_t bit = 1U << (corner.vertex % 32);
    if (!corner.moved() || (atomicOr(&work_.marks[corner.vertex / 32], bit) & bit) != 0) {
      return;
    }
    // What there is no room for is counted still.
    if (const std::uint32_t place = atomicAdd(listed_, 1U); place < work_.list_size) {
      work_.list[place].vertex = corner.vertex;
    }
  }

  const Work& work_;
  double threshold_;
  std::uint32_t* listed_;
};

/// Threads of a block that makes rounds, one on each multiprocessor.
constexpr unsigned round_threads = 1024;
/// Threads that look at the elements of one vertex together.
constexpr unsigned team_size = 8;

/// The rounds that take offenders back, until there are none or more than the list holds. All blocks are on the device
/// at the same time.
template <class View>
__global__ void __launch_bounds__(round_threads, 1) make_rounds(View view, Work work, CommitState* state) {
  if (!view.run_is_over() || state->nothing_offends()) {
    return;
  }
  const Positions<View> positions(view);
  const unsigned long long before = state->before;
  const OffenderSearch search(work, before, &state->listed);
  RepeatedBarrier barrier(state->barriers);
  const std::int64_t thread = thread_index();
  const std::int64_t threads = static_cast<std::int64_t>(gridDim.x) * round_threads;
  // First all elements, but for those of blocks without anything that is spoilt or below T.
  for (std::int64_t i = thread; i < view.rings.size; i += threads) {
    if (work.verdicts[i / block_size] > before) {
      const auto v = static_cast<std::int32_t>(i);
      for_elements(view, positions, v, v, search);
    }
  }
  std::uint32_t taken_back = 0;
  std::uint32_t rounds = 0;
  std::uint32_t listed = 0;
  for (;;) {
    barrier.wait();
    listed = load_relaxed(&state->listed);
    if (listed == taken_back || listed > work.list_size) {
      break;
    }
    ++rounds;
    for (std::int64_t i = taken_back + thread; i < listed; i += threads) {
      const std::int32_t v = work.list[i].vertex;
      work.list[i] = {v, view.input_index[v], positions.stored(v)};
      positions.take_back(v);
      work.marks[v / 32] = 0;  // all marks are of vertices that go back
    }
    barrier.wait();
    // Then what has changed: the elements of the vertices that went back.
    for (std::int64_t i = taken_back + thread / team_size; i < listed; i += threads / team_size) {
      const std::int32_t v = work.list[i].vertex;
      const std::int32_t size = view.rings.ring_size(v);
      const auto ring = view.rings.ring(v);
      for (auto k = static_cast<std::int32_t>(thread % team_size); k < size; k += team_size) {
        search(positions.corner(v), positions.corner(ring[k]), positions.corner(ring[k + 1 < size ? k + 1 : 0]));
      }
    }
    taken_back = listed;
  }
  if (thread == 0) {
    state->taken_back = taken_back;
    state->rounds += rounds;
    state->settled = listed == taken_back ? 1 : 0;
  }
}

/// Writes the vertices that are elsewhere; if `guarded`, only where nothing offends any more.
template <class View>
__global__ void __launch_bounds__(block_size)
    write_moved(View view, bool guarded, double2* stored, CommitState* state) {
  if (!view.run_is_over() || (guarded && !state->may_write())) {
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

/// `has_second`: `second` is not `first` again.
template <class T, Layout layout>
__global__ void __launch_bounds__(block_size)
    enter(const double2* stored, const std::int32_t* input_index, std::uint32_t vertex_count, const LocalFrame* frame,
          double2* before, PointArrays<T, layout> first, PointArrays<T, layout> second, bool has_second) {
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i < vertex_count) {
    const auto v = static_cast<std::int32_t>(i);
    const double2 point = stored[input_index[v]];
    const Point2<double> local = frame->enter({point.x, point.y});
    before[v] = {local.x, local.y};
    first.store(v, narrow<T>(local));
    if (has_second) {
      second.store(v, narrow<T>(local));
    }
  }
}

/// Queues the rounds of a guarded commit, and the writing. Returns the number of launches.
template <class View>
std::int64_t launch_rounds(const View& view, CommitBuffers& buffers, Point2<double>* stored, CommitState* state,
                           cudaStream_t stream) {
  if (buffers.guard()) {
    View view_argument = view;
    Work work{buffers.verdicts.data(), buffers.marks.data(), buffers.list.data(),
              static_cast<std::uint32_t>(buffers.list.size())};
    void* arguments[] = {&view_argument, &work, &state};
    const auto blocks =
        std::min(blocks_for(view.rings.size, round_threads), static_cast<unsigned>(multiprocessor_count()));
    TRISMOOTH_CUDA_CHECK(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(&make_rounds<View>), dim3(blocks),
                                                     dim3(round_threads), arguments, 0, stream));
  }
  write_moved<<<blocks_for(view.rings.size), block_size, 0, stream>>>(view, buffers.guard(),
                                                                      reinterpret_cast<double2*>(stored), state);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
  return buffers.guard() ? 2 : 1;
}

/// Adds the first `count` of the list.
void collect(const DeviceBuffer<Offender>& list, std::uint32_t count, std::vector<RevertedVertex>& reverted) {
  std::vector<Offender> offenders(count);
  list.download(offenders);
  for (const Offender& offender : offenders) {
    reverted.push_back({offender.input, offender.position});
  }
}

}  // namespace

CommitBuffers::CommitBuffers(Context& context, std::int32_t free_count)
    : verdicts(context, blocks_for(free_count)),
      marks(context, (static_cast<std::size_t>(free_count) + 31) / 32),
      list(context, static_cast<std::size_t>(list_size(free_count))) {
  marks.fill_bytes(0);
}

template <class T, Layout layout>
std::int64_t launch_commit(const CommitInput<T, layout>& input, CommitBuffers& buffers, Point2<double>* stored,
                           CommitState* state, cudaStream_t stream) {
  std::int64_t launches = 0;
  with_view(input, [&](const auto& view) {
    if (buffers.guard()) {
      judge<<<blocks_for(view.rings.size), block_size, 0, stream>>>(view, buffers.verdicts.data(), state);
      TRISMOOTH_CUDA_CHECK(cudaGetLastError());
      ++launches;
    }
    launches += launch_rounds(view, buffers, stored, state, stream);
  });
  return launches;
}

template <class T, Layout layout>
CommitOutcome finish_commit(Context& context, const CommitInput<T, layout>& input, CommitBuffers& buffers,
                            Point2<double>* stored, CommitState* state, CommitState found, std::int64_t& launches) {
  const auto free_count = static_cast<std::size_t>(input.rings->free_count());
  CommitOutcome outcome;
  collect(buffers.list, found.taken_back, outcome.reverted);
  while (!found.may_write()) {
    // The round that did not fit is found once more, among all elements: those of vertices that went back have changed
    // since they were judged.
    buffers.marks.fill_bytes(0);
    buffers.verdicts.fill_bytes(0xFF);
    if (const std::size_t round_size = found.listed - found.taken_back; round_size > buffers.list.size()) {
      buffers.list = DeviceBuffer<Offender>(context, std::min(2 * round_size, free_count));
    }
    found.listed = 0;
    std::ranges::fill(found.barriers, 0ULL);
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(state, &found, sizeof(found), cudaMemcpyHostToDevice, context.stream()));
    with_view(input,
              [&](const auto& view) { launches += launch_rounds(view, buffers, stored, state, context.stream()); });
    found = download(context, state);
    collect(buffers.list, found.taken_back, outcome.reverted);
  }
  std::ranges::sort(outcome.reverted, {}, &RevertedVertex::vertex);
  outcome.rounds = found.rounds;
  outcome.moved = found.moved;
  return outcome;
}

template <class T, Layout layout>
void launch_enter(const Point2<double>* stored, const std::int32_t* input_index, std::int32_t vertex_count,
                  const LocalFrame* frame, Point2<double>* before, const PointArrays<T, layout>& first,
                  const PointArrays<T, layout>& second, cudaStream_t stream) {
  const bool has_second = std::memcmp(&first, &second, sizeof(first)) != 0;
  enter<<<blocks_for(vertex_count), block_size, 0, stream>>>(
      reinterpret_cast<const double2*>(stored), input_index, static_cast<std::uint32_t>(vertex_count), frame,
      reinterpret_cast<double2*>(before), first, second, has_second);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

#define INSTANTIATE(T, layout)                                                                                      \
  template std::int64_t launch_commit(const CommitInput<T, layout>&, CommitBuffers&, Point2<double>*, CommitState*, \
                                      cudaStream_t);                                                                \
  template CommitOutcome finish_commit(Context&, const CommitInput<T, layout>&, CommitBuffers&, Point2<double>*,    \
                                       CommitState*, CommitState, std::int64_t&);                                   \
  template void launch_enter(const Point2<double>*, const std::int32_t*, std::int32_t, const LocalFrame*,           \
                             Point2<double>*, const PointArrays<T, layout>&, const PointArrays<T, layout>&,         \
                             cudaStream_t)
INSTANTIATE(float, Layout::aos);
INSTANTIATE(float, Layout::soa);
INSTANTIATE(double, Layout::aos);
INSTANTIATE(double, Layout::soa);

}  // namespace trismooth::cuda
