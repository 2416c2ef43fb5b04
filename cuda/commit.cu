#include <algorithm>
#include <limits>
#include <span>

#include "trismooth/cuda/commit.h"
#include "trismooth/cuda/launch.h"
#include "trismooth/cuda/sweep_state.h"
#include "trismooth/cuda/thread_index.cuh"
#include "trismooth/smoothing/guard_rule.h"

namespace trismooth::cuda {

namespace {

template <class T>
__device__ Point2<T> narrow(Point2<double> point) {
  return {static_cast<T>(point.x), static_cast<T>(point.y)};
}

/// Where the file would have the free vertex, whose working position has changed.
template <class T, Layout layout>
__device__ Point2<double> stored_position(const CommitView<T, layout>& view, Point2<T> working) {
  const Point2<double> left = view.frame.leave({static_cast<double>(working.x), static_cast<double>(working.y)});
  return view.storage == Storage::float64 ? left
                                          : Point2<double>{static_cast<double>(static_cast<float>(left.x)),
                                                           static_cast<double>(static_cast<float>(left.y))};
}

/// The same in the local frame: what the commit evaluates.
template <class T, Layout layout>
__device__ Point2<double> after(const CommitView<T, layout>& view, std::int32_t v) {
  const Point2<double> before = view.before[v];
  if (v >= view.rings.size) {
    return before;
  }
  const Point2<T> working = view.working.load(v);
  return working == narrow<T>(before) ? before : view.frame.enter(stored_position(view, working));
}

template <class T, Layout layout>
__device__ bool has_moved(const CommitView<T, layout>& view, std::int32_t v) {
  return !(after(view, v) == view.before[v]);
}

template <class T, Layout layout>
__device__ double quotient_before(const CommitView<T, layout>& view, std::int32_t a, std::int32_t b, std::int32_t c) {
  return canonical_quotient(view.before[a], view.before[b], view.before[c], view.input_index[a], view.input_index[b],
                            view.input_index[c]);
}

/// Calls `visit(b, c)` for each element (v, b, c) around the vertex until it answers false.
template <class Visit>
__device__ void for_elements(const RingsView& rings, std::int32_t v, const Visit& visit) {
  const std::int32_t* const ring = rings.ring(v);
  const std::int32_t size = rings.ring_size(v);
  for (std::int32_t i = 0; i < size; ++i) {
    if (!visit(ring[i], ring[i + 1 == size ? 0 : i + 1])) {
      return;
    }
  }
}

/// What the kernels of the commit tell each other and the host; all zeros to begin with.
struct GuardState {
  unsigned long long threshold;  ///< falling_key() of T, the smallest quotient before; 0: nothing moved
  unsigned long long offending;  ///< vertices found in this round
  unsigned long long listed;     ///< of those, how many are in the list
  unsigned long long moved;      ///< vertices written
};

/// T, and every moved vertex is suspect to begin with.
template <class T, Layout layout>
__global__ void find_threshold(CommitView<T, layout> view, std::uint8_t* suspect, GuardState* state) {
  const std::int64_t i = thread_index();
  unsigned long long key = 0;
  if (i < view.rings.size) {
    const auto v = static_cast<std::int32_t>(i);
    const bool moved = has_moved(view, v);
    suspect[v] = moved ? 1 : 0;
    if (moved) {
      for_elements(view.rings, v, [&](std::int32_t b, std::int32_t c) {
        const unsigned long long of_element = falling_key(quotient_before(view, v, b, c));
        key = of_element > key ? of_element : key;
        return true;
      });
    }
  }
  for (int distance = 16; distance > 0; distance /= 2) {
    const unsigned long long other = __shfl_xor_sync(0xffffffffU, key, distance);
    key = other > key ? other : key;
  }
  if (threadIdx.x % 32 == 0 && key > *static_cast<volatile unsigned long long*>(&state->threshold)) {
    atomicMax(&state->threshold, key);
  }
}

/// Marks the suspects that have an offending element; every moved vertex of such an element finds it by itself.
template <class T, Layout layout>
__global__ void find_offenders(CommitView<T, layout> view, std::uint8_t* suspect, std::uint8_t* offending,
                               GuardState* state) {
  const std::int64_t i = thread_index();
  bool offends_here = false;
  if (i < view.rings.size) {
    const auto v = static_cast<std::int32_t>(i);
    if (suspect[v] != 0) {
      suspect[v] = 0;
      const double threshold = from_falling_key(state->threshold);
      const Point2<double> own = after(view, v);
      for_elements(view.rings, v, [&](std::int32_t b, std::int32_t c) {
        const double quotient = canonical_quotient(own, after(view, b), after(view, c), view.input_index[v],
                                                   view.input_index[b], view.input_index[c]);
        // Most elements are beyond reproach, whatever they were before.
        offends_here =
            !(quotient > 0 && quotient >= threshold) && offends(quotient_before(view, v, b, c), quotient, threshold);
        return !offends_here;
      });
    }
    offending[v] = offends_here ? 1 : 0;
  }
  const unsigned found = __ballot_sync(0xffffffffU, offends_here);
  if (threadIdx.x % 32 == 0 && found != 0) {
    atomicAdd(&state->offending, static_cast<unsigned long long>(__popc(found)));
  }
}

struct Offender {
  std::int32_t vertex;      ///< packed
  std::int32_t input;       ///< the caller's number
  Point2<double> position;  ///< where it would have been stored
};

/// Puts the offenders back and lists them.
template <class T, Layout layout>
__global__ void take_back(CommitView<T, layout> view, const std::uint8_t* offending, GuardState* state,
                          Offender* list) {
  const std::int64_t i = thread_index();
  if (i >= view.rings.size || offending[i] == 0) {
    return;
  }
  const auto v = static_cast<std::int32_t>(i);
  const Point2<double> position = stored_position(view, view.working.load(v));
  list[atomicAdd(&state->listed, 1ULL)] = {v, view.input_index[v], position};
  view.working.store(v, narrow<T>(view.before[v]));
}

/// The elements of the offenders have changed, so their moved neighbours are suspect next.
template <class T, Layout layout>
__global__ void suspect_neighbours(CommitView<T, layout> view, const Offender* list, std::uint32_t count,
                                   std::uint8_t* suspect) {
  const std::int64_t i = thread_index();
  if (i >= count) {
    return;
  }
  const std::int32_t v = list[i].vertex;
  const std::int32_t* const ring = view.rings.ring(v);
  for (std::int32_t k = 0; k < view.rings.ring_size(v); ++k) {
    if (ring[k] < view.rings.size && has_moved(view, ring[k])) {
      suspect[ring[k]] = 1;
    }
  }
}

template <class T, Layout layout>
__global__ void write_moved(CommitView<T, layout> view, Point2<double>* stored, GuardState* state) {
  const std::int64_t i = thread_index();
  bool moved = false;
  if (i < view.rings.size) {
    const auto v = static_cast<std::int32_t>(i);
    moved = has_moved(view, v);
    if (moved) {
      stored[view.input_index[v]] = stored_position(view, view.working.load(v));
    }
  }
  const unsigned found = __ballot_sync(0xffffffffU, moved);
  if (threadIdx.x % 32 == 0 && found != 0) {
    atomicAdd(&state->moved, static_cast<unsigned long long>(__popc(found)));
  }
}

template <class T, Layout layout>
__global__ void enter(const Point2<double>* stored, const std::int32_t* input_index, std::int32_t vertex_count,
                      LocalFrame frame, Point2<double>* before, PointArrays<T, layout> first,
                      PointArrays<T, layout> second) {
  const std::int64_t i = thread_index();
  if (i < vertex_count) {
    const auto v = static_cast<std::int32_t>(i);
    const Point2<double> local = frame.enter(stored[input_index[v]]);
    before[v] = local;
    first.store(v, narrow<T>(local));
    second.store(v, narrow<T>(local));
  }
}

}  // namespace

template <class T, Layout layout>
CommitOutcome commit(Context& context, const CommitView<T, layout>& view, bool guarded, Point2<double>* stored) {
  CommitOutcome outcome;
  const std::int32_t count = view.rings.size;
  if (count == 0) {
    return outcome;
  }
  const unsigned blocks = blocks_for(count);
  cudaStream_t stream = context.stream();
  const auto launched = [&] {
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    ++outcome.launches;
  };
  DeviceBuffer<GuardState> state(context, 1);
  state.fill_bytes(0);
  if (guarded) {
    DeviceBuffer<std::uint8_t> suspect(context, static_cast<std::size_t>(count));
    DeviceBuffer<std::uint8_t> offending(context, static_cast<std::size_t>(count));
    find_threshold<<<blocks, block_size, 0, stream>>>(view, suspect.data(), state.data());
    launched();
    for (;;) {
      find_offenders<<<blocks, block_size, 0, stream>>>(view, suspect.data(), offending.data(), state.data());
      launched();
      GuardState found{};
      state.download({&found, 1});
      if (found.offending == 0) {
        break;
      }
      ++outcome.rounds;
      DeviceBuffer<Offender> list(context, found.offending);
      take_back<<<blocks, block_size, 0, stream>>>(view, offending.data(), state.data(), list.data());
      launched();
      const auto offenders = static_cast<std::uint32_t>(found.offending);
      suspect_neighbours<<<blocks_for(offenders), block_size, 0, stream>>>(view, list.data(), offenders,
                                                                           suspect.data());
      launched();
      std::vector<Offender> taken(found.offending);
      list.download(taken);
      for (const Offender& offender : taken) {
        outcome.reverted.push_back({offender.input, offender.position});
      }
      found.offending = 0;
      found.listed = 0;
      state.upload({&found, 1});
    }
    std::ranges::sort(outcome.reverted, {}, &RevertedVertex::vertex);
  }
  write_moved<<<blocks, block_size, 0, stream>>>(view, stored, state.data());
  launched();
  GuardState written{};
  state.download({&written, 1});
  outcome.moved = static_cast<std::int64_t>(written.moved);
  return outcome;
}

template <class T, Layout layout>
void launch_enter(const Point2<double>* stored, const std::int32_t* input_index, std::int32_t vertex_count,
                  const LocalFrame& frame, Point2<double>* before, const PointArrays<T, layout>& first,
                  const PointArrays<T, layout>& second, cudaStream_t stream) {
  enter<<<blocks_for(vertex_count), block_size, 0, stream>>>(stored, input_index, vertex_count, frame, before, first,
                                                             second);
  TRISMOOTH_CUDA_CHECK(cudaGetLastError());
}

#define INSTANTIATE(T, layout)                                                                              \
  template CommitOutcome commit(Context&, const CommitView<T, layout>&, bool, Point2<double>*);             \
  template void launch_enter(const Point2<double>*, const std::int32_t*, std::int32_t, const LocalFrame&,   \
                             Point2<double>*, const PointArrays<T, layout>&, const PointArrays<T, layout>&, \
                             cudaStream_t)
INSTANTIATE(float, Layout::aos);
INSTANTIATE(float, Layout::soa);
INSTANTIATE(double, Layout::aos);
INSTANTIATE(double, Layout::soa);

}  // namespace trismooth::cuda
