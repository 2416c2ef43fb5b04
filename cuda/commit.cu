#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "trismooth/cuda/commit.h"
#include "trismooth/cuda/device_algorithms.h"
#include "trismooth/cuda/largest_key.cuh"
#include "trismooth/cuda/launch.h"
#include "trismooth/smoothing/guard_rule.h"

namespace trismooth::cuda {

namespace {

/// A CommitInput with one kind of rings, for kernels.
template <class ScalarType, Layout layout, class Rings>
struct CommitView {
  using Scalar = ScalarType;
  using Points = PointArrays<Scalar, layout>;

  Rings rings;                      ///< of the free vertices
  const std::int32_t* input_index;  ///< of all vertices
  const double2* before;
  Points first;
  Points second;
  const LoopState* state;
  bool is_over;
  const LocalFrame* frame;
  Storage storage;

  __device__ bool run_is_over() const { return is_over || state->stop != LoopState::running; }
  __device__ Points working() const { return state->current == 0 ? first : second; }
};

template <class T>
__device__ Point2<T> narrow(Point2<double> point) {
  return {static_cast<T>(point.x), static_cast<T>(point.y)};
}

/// A vertex as the commit sees it.
struct Corner {
  Point2<double> before;
  Point2<double> after;
  std::int32_t input;  ///< the caller's number

  __device__ bool moved() const { return !(after == before); }
};

/// Where vertices are, in the local frame, and would be stored.
template <class View>
class Positions {
 public:
  using T = typename View::Scalar;

  __device__ explicit Positions(const View& view)
      : free_count_(view.rings.size),
        input_index_(view.input_index),
        before_(view.before),
        working_(view.working()),
        frame_(*view.frame),
        storage_(view.storage) {}

  __device__ Point2<double> before(std::int32_t v) const {
    const double2 point = before_[v];
    return {point.x, point.y};
  }
  /// Where the file would have a vertex whose working position has changed.
  __device__ Point2<double> stored(Point2<T> working) const {
    const Point2<double> left = frame_.leave({static_cast<double>(working.x), static_cast<double>(working.y)});
    return storage_ == Storage::float64 ? left
                                        : Point2<double>{static_cast<double>(static_cast<float>(left.x)),
                                                         static_cast<double>(static_cast<float>(left.y))};
  }
  __device__ Point2<double> stored(std::int32_t v) const { return stored(working_.load(v)); }
  /// The same in the local frame: what the commit evaluates.
  __device__ Point2<double> after(std::int32_t v, Point2<double> before) const {
    if (v >= free_count_) {
      return before;
    }
    const Point2<T> working = working_.load(v);
    return working == narrow<T>(before) ? before : frame_.enter(stored(working));
  }
  __device__ Corner corner(std::int32_t v) const {
    // Asked for first: it arrives while the positions are on their way.
    const std::int32_t input = input_index_[v];
    const Point2<double> old = before(v);
    return {old, after(v, old), input};
  }
  __device__ void take_back(std::int32_t v) const { working_.store(v, narrow<T>(before(v))); }

 private:
  std::int32_t free_count_;
  const std::int32_t* input_index_;
  const double2* before_;
  typename View::Points working_;
  LocalFrame frame_;
  Storage storage_;
};

struct Quotients {
  double before;
  double after;
};

/// canonical_quotient() of the element (a, b, c), before and after. The corner with the smallest input number is
/// brought to the front without branches, so that the threads of a warp divide together.
__device__ Quotients quotients(const Corner& a, const Corner& b, const Corner& c) {
  const bool a_first = a.input <= b.input && a.input <= c.input;
  const bool b_first = !a_first && b.input <= c.input;
  const auto pick = [&](Point2<double> if_a, Point2<double> if_b, Point2<double> if_c) {
    return Point2<double>{a_first ? if_a.x : (b_first ? if_b.x : if_c.x),
                          a_first ? if_a.y : (b_first ? if_b.y : if_c.y)};
  };
  const auto quotient = [&](Point2<double> p, Point2<double> q, Point2<double> r) {
    return shape_quotient(pick(p, q, r), pick(q, r, p), pick(r, p, q));
  };
  return {quotient(a.before, b.before, c.before), quotient(a.after, b.after, c.after)};
}

/// Calls visit(own, b, c) for the elements (v, b, c) around the vertex whose corners have numbers from `lowest` on, of
/// which v is one, until it answers false. Each corner is looked at once, but for one.
template <class View, class Visit>
__device__ void for_elements(const View& view, const Positions<View>& positions, std::int32_t v, std::int32_t lowest,
                             const Visit& visit) {
  const std::int32_t size = view.rings.ring_size(v);
  if (size == 0) {
    return;
  }
  const auto ring = view.rings.ring(v);
  const Corner own = positions.corner(v);
  Corner last{};
  bool has_last = false;
  std::int32_t number = ring[size - 1];
  for (std::int32_t i = 0; i <= size; ++i) {
    const std::int32_t following = ring[i < size ? i : 0];
    const bool counts = number >= lowest;
    Corner next{};
    if (counts) {
      next = positions.corner(number);
      if (has_last && !visit(own, last, next)) {
        return;
      }
    }
    last = next;
    has_last = counts;
    number = following;
  }
}

__device__ void raise(unsigned long long* word, unsigned long long key) {
  // Most blocks have nothing to add.
  if (key > *static_cast<volatile unsigned long long*>(word)) {
    atomicMax(word, key);
  }
}

/// Judges every element of a moved vertex once: at the corner with the smallest packed number, which is a free vertex
/// if any is, as these are numbered first.
template <class View>
__global__ void __launch_bounds__(block_size, 4) judge(View view, CommitState* state) {
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
      return true;
    });
  }
  join_largest(&keys[0], falling_key(smallest.before));
  join_largest(&keys[1], falling_key(smallest.after));
  const bool block_spoilt = __syncthreads_or(spoilt ? 1 : 0) != 0;
  if (threadIdx.x == 0) {
    raise(&state->before, keys[0]);
    raise(&state->after, keys[1]);
    if (block_spoilt) {
      state->spoilt = 1;
    }
  }
}

/// Writes the vertices that are elsewhere; if `guarded`, only where nothing offends.
template <class View>
__global__ void __launch_bounds__(block_size)
    write_moved(View view, bool guarded, double2* stored, CommitState* state) {
  if (!view.run_is_over() || (guarded && !state->nothing_offends())) {
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

/// Marks the suspects that have moved and have an offending element; every moved vertex of such an element finds it by
/// itself.
template <class View>
__global__ void __launch_bounds__(block_size)
    find_offenders(View view, std::uint8_t* suspect, std::uint8_t* offending, CommitState* state) {
  bool offends_here = false;
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i < static_cast<std::uint32_t>(view.rings.size)) {
    if (suspect[i] != 0) {
      suspect[i] = 0;
      const Positions<View> positions(view);
      const double threshold = from_falling_key(state->before);
      for_elements(view, positions, static_cast<std::int32_t>(i), 0,
                   [&](const Corner& own, const Corner& b, const Corner& c) {
                     if (!own.moved()) {
                       return false;
                     }
                     const Quotients found = quotients(own, b, c);
                     offends_here = offends(found.before, found.after, threshold);
                     return !offends_here;
                   });
    }
    offending[i] = offends_here ? 1 : 0;
  }
  const int found = __syncthreads_count(offends_here ? 1 : 0);
  if (threadIdx.x == 0 && found > 0) {
    atomicAdd(&state->offending, static_cast<std::uint32_t>(found));
  }
}

struct Offender {
  std::int32_t vertex;      ///< packed
  std::int32_t input;       ///< the caller's number
  Point2<double> position;  ///< where it would have been stored
};

/// Puts the offenders of a round back and lists them; `listed_before`: how many those of earlier rounds were.
template <class View>
__global__ void __launch_bounds__(block_size) take_back(View view, const std::uint8_t* offending, CommitState* state,
                                                        std::uint32_t listed_before, Offender* list) {
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i >= static_cast<std::uint32_t>(view.rings.size) || offending[i] == 0) {
    return;
  }
  const Positions<View> positions(view);
  const auto v = static_cast<std::int32_t>(i);
  list[atomicAdd(&state->listed, 1U) - listed_before] = {v, view.input_index[v], positions.stored(v)};
  positions.take_back(v);
}

/// The elements of the offenders have changed, so their neighbours are suspect next.
template <class View>
__global__ void __launch_bounds__(block_size)
    suspect_neighbours(View view, const Offender* list, std::uint32_t count, std::uint8_t* suspect) {
  const std::uint32_t i = blockIdx.x * block_size + threadIdx.x;
  if (i >= count) {
    return;
  }
  const std::int32_t v = list[i].vertex;
  const auto ring = view.rings.ring(v);
  for (std::int32_t k = 0; k < view.rings.ring_size(v); ++k) {
    if (ring[k] < view.rings.size) {
      suspect[ring[k]] = 1;
    }
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

/// Calls body(view) with the input as kernels take it.
template <class T, Layout layout, class Body>
void with_view(const CommitInput<T, layout>& input, const Body& body) {
  const auto call = [&](const auto& rings) {
    body(CommitView<T, layout, std::remove_cvref_t<decltype(rings)>>{
        rings, input.rings->input_index.data(), reinterpret_cast<const double2*>(input.before), input.first,
        input.second, input.state, input.is_over, input.frame, input.storage});
  };
  if (input.rings->near_rings.records.size() > 0) {
    call(input.rings->near_rings.view());
  } else if (input.rings->wide_rings.records.size() > 0) {
    call(input.rings->wide_rings.view());
  } else {
    call(input.rings->rings.view());
  }
}

/// Queues the launches of a commit, and counts them.
template <class View>
class CommitLauncher {
 public:
  CommitLauncher(const View& view, cudaStream_t stream, std::int64_t& launches)
      : view_(view), stream_(stream), launches_(launches) {}

  /// One thread for each of `count`.
  template <class... Parameters, class... Arguments>
  void operator()(void (*kernel)(View, Parameters...), std::int64_t count, Arguments... arguments) const {
    kernel<<<blocks_for(count), block_size, 0, stream_>>>(view_, arguments...);
    TRISMOOTH_CUDA_CHECK(cudaGetLastError());
    ++launches_;
  }

 private:
  View view_;
  cudaStream_t stream_;
  std::int64_t& launches_;
};

/// Takes offenders back until there are none.
template <class View>
void take_all_back(Context& context, const View& view, CommitState* state, const CommitLauncher<View>& launch,
                   CommitOutcome& outcome) {
  const std::int32_t count = view.rings.size;
  DeviceBuffer<std::uint8_t> suspect(context, static_cast<std::size_t>(count));
  DeviceBuffer<std::uint8_t> offending(context, static_cast<std::size_t>(count));
  suspect.fill_bytes(1);
  std::vector<DeviceBuffer<Offender>> lists;
  std::uint32_t listed = 0;
  for (;;) {
    launch(find_offenders<View>, count, suspect.data(), offending.data(), state);
    const std::uint32_t found = download(context, state).offending - listed;
    if (found == 0) {
      break;
    }
    ++outcome.rounds;
    DeviceBuffer<Offender>& list = lists.emplace_back(context, found);
    launch(take_back<View>, count, offending.data(), state, listed, list.data());
    launch(suspect_neighbours<View>, found, list.data(), found, suspect.data());
    listed += found;
  }
  std::vector<Offender> taken;
  for (const DeviceBuffer<Offender>& list : lists) {
    taken.resize(list.size());
    list.download(taken);
    for (const Offender& offender : taken) {
      outcome.reverted.push_back({offender.input, offender.position});
    }
  }
  std::ranges::sort(outcome.reverted, {}, &RevertedVertex::vertex);
}

}  // namespace

template <class T, Layout layout>
std::int64_t launch_commit(const CommitInput<T, layout>& input, bool guarded, Point2<double>* stored,
                           CommitState* state, cudaStream_t stream) {
  std::int64_t launches = 0;
  with_view(input, [&]<class View>(const View& view) {
    const CommitLauncher<View> launch(view, stream, launches);
    if (guarded) {
      launch(judge<View>, view.rings.size, state);
    }
    launch(write_moved<View>, view.rings.size, guarded, reinterpret_cast<double2*>(stored), state);
  });
  return launches;
}

template <class T, Layout layout>
CommitOutcome finish_commit(Context& context, const CommitInput<T, layout>& input, Point2<double>* stored,
                            CommitState* state, const CommitState& found, std::int64_t& launches) {
  CommitOutcome outcome;
  if (found.nothing_offends()) {
    outcome.moved = found.moved;
    return outcome;
  }
  with_view(input, [&]<class View>(const View& view) {
    const CommitLauncher<View> launch(view, context.stream(), launches);
    take_all_back(context, view, state, launch, outcome);
    launch(write_moved<View>, view.rings.size, false, reinterpret_cast<double2*>(stored), state);
  });
  outcome.moved = download(context, state).moved;
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

#define INSTANTIATE(T, layout)                                                                                 \
  template std::int64_t launch_commit(const CommitInput<T, layout>&, bool, Point2<double>*, CommitState*,      \
                                      cudaStream_t);                                                           \
  template CommitOutcome finish_commit(Context&, const CommitInput<T, layout>&, Point2<double>*, CommitState*, \
                                       const CommitState&, std::int64_t&);                                     \
  template void launch_enter(const Point2<double>*, const std::int32_t*, std::int32_t, const LocalFrame*,      \
                             Point2<double>*, const PointArrays<T, layout>&, const PointArrays<T, layout>&,    \
                             cudaStream_t)
INSTANTIATE(float, Layout::aos);
INSTANTIATE(float, Layout::soa);
INSTANTIATE(double, Layout::aos);
INSTANTIATE(double, Layout::soa);

}  // namespace trismooth::cuda
