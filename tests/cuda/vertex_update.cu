// SPDX-License-Identifier: BSD-3-Clause
// What the resident execution evaluates a vertex with, in registers, by a team, without dividing: it has to do exactly
// what the method's own function says of the same ring.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/update/reciprocals.cuh"
#include "trismooth/cuda/update/register_ring.cuh"
#include "trismooth/cuda/update/team_update.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"
#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "hard_rings.h"
#include "update_checks.h"

using namespace trismooth;
using hard_rings::Kind;
using hard_rings::RingView;
using hard_rings::Vertex;
using hard_rings::Vertices;
using namespace update_checks;

namespace {

// No multiple of a warp.
constexpr int vertex_count = 262144 + 13;
constexpr int register_capacity = 12;

/// By the method's own function.
template <class Update, class T, class Ring>
constexpr TRISMOOTH_HOST_DEVICE trismooth::VertexMove<T> defined_update(Point2<T> position, const Ring& ring) {
  return {Update::template update<T>(position, ring), sum_of_tally(position, ring)};
}

template <class Update, class T>
std::vector<trismooth::VertexMove<T>> defined_updates(const std::vector<Vertex<T>>& vertices) {
  std::vector<trismooth::VertexMove<T>> updates;
  for (const Vertex<T>& vertex : vertices) {
    updates.push_back(defined_update<Update>(vertex.position, vertex.ring()));
  }
  return updates;
}

/// The records that fetch_ring() reads. Some rings that would fit into slots are in the list of long ones all the same:
/// in a mesh their neighbours may be too far away.
template <class Slot>
struct Records {
  std::vector<cuda::RingRecord<Slot>> records;
  std::vector<std::int32_t> long_rings;

  template <class T>
  explicit Records(const PointList<T>& list) {
    using Record = cuda::RingRecord<Slot>;
    for (std::size_t i = 0; i < list.numbers.size(); ++i) {
      const std::int32_t first = list.numbers[i] + 1;
      const std::int32_t size = list.sizes[i];
      if (size < Record::smallest_ring || size > Record::slots || i % 8 == 0) {
        records.push_back(Record::of_long_ring(static_cast<std::uint32_t>(long_rings.size()), size));
        for (std::int32_t n = 0; n < size; ++n) {
          long_rings.push_back(first + n);
        }
      } else {
        Slot slots[Record::slots];
        for (std::int32_t n = 0; n < Record::slots; ++n) {
          slots[n] = static_cast<Slot>((sizeof(Slot) == 2 ? 1 : first) + (n < size ? n : 0));
        }
        Record record{};
        static_assert(sizeof(record.words) == sizeof(slots));
        std::memcpy(record.words, slots, sizeof(slots));
        records.push_back(record);
      }
    }
  }
};

template <class T>
struct Attempt {
  trismooth::VertexMove<T> result;
  int size;  ///< of the ring in registers
  bool decided;
};

template <class T, class Slot>
struct RegisterInput {
  int count;
  const std::int32_t* numbers;
  const std::uint8_t* active;
  const cuda::RingRecord<Slot>* records;
  const std::int32_t* long_rings;
  cuda::PointArray<T> points;
};

template <class Update, class T, class Slot>
__global__ void try_in_registers(RegisterInput<T, Slot> input, Attempt<T>* attempts) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const bool active = i < input.count && input.active[i] != 0;
  const int own = active ? i : 0;
  const std::int32_t v = input.numbers[own];
  cuda::RegisterRing<T, register_capacity> ring;
  cuda::fetch_ring(v, input.records[own], active, input.long_rings, input.points, ring);
  Attempt<T> attempt{};
  attempt.size = ring.size;
  if (ring.size > 0) {
    attempt.decided = cuda::try_update(Update{}, input.points.load(v), ring, attempt.result);
  }
  if (i < input.count) {
    attempts[i] = attempt;
  }
}

struct Decisions {
  int ordinary = 0;
  int decided_ordinary = 0;
  int undecided = 0;
  int undecided_ties = 0;
  int moved = 0;
  int stayed = 0;
};

/// What try_update() says of every vertex: where it has decided it has to be right.
template <class Update, class Slot, class T>
Decisions check_in_registers(const Vertices<T>& vertices) {
  const PointList<T> list(vertices.all);
  const Records<Slot> rings(list);
  const SharedArray<cuda::PointRecord<T>> points(list.records());
  const SharedArray<std::int32_t> numbers(list.numbers);
  const SharedArray<std::uint8_t> active(vertices.active);
  const SharedArray<cuda::RingRecord<Slot>> records(rings.records);
  const SharedArray<std::int32_t> long_rings(rings.long_rings);
  const SharedArray<Attempt<T>> attempts(vertices.all.size());
  const RegisterInput<T, Slot> input{vertex_count,   numbers.data(),    active.data(),
                                     records.data(), long_rings.data(), {points.data()}};
  try_in_registers<Update><<<cuda::blocks_for(vertex_count), cuda::block_size>>>(input, attempts.data());
  finish_launch();

  const std::vector<trismooth::VertexMove<T>> expected = defined_updates<Update>(vertices.all);
  Decisions decisions;
  Count wrong_size;
  Count wrong_move;
  Count wrong_sum;
  for (int i = 0; i < vertex_count; ++i) {
    const auto place = static_cast<std::size_t>(i);
    const Vertex<T>& vertex = vertices.all[place];
    const bool fits = vertices.active[place] != 0 && vertex.ring_size() <= register_capacity;
    const Attempt<T>& attempt = attempts[i];
    wrong_size.add(attempt.size != (fits ? vertex.ring_size() : 0), i);
    if (!fits) {
      continue;
    }
    const Move<T>& move = attempt.result.move;
    wrong_move.add(attempt.decided && !same_bits(move, expected[place].move), i);
    wrong_sum.add(attempt.decided && !same_bits(attempt.result.squares, expected[place].squares), i);
    const bool ordinary = vertex.kind == Kind::ordinary && vertex.ring_size() >= 3;
    decisions.ordinary += ordinary ? 1 : 0;
    decisions.decided_ordinary += ordinary && attempt.decided ? 1 : 0;
    decisions.undecided += attempt.decided ? 0 : 1;
    decisions.undecided_ties += vertex.kind == Kind::tied && !attempt.decided ? 1 : 0;
    decisions.moved += attempt.decided && move.moved ? 1 : 0;
    decisions.stayed += attempt.decided && !move.moved ? 1 : 0;
  }
  require_none("a ring that was not fetched as it is", wrong_size);
  require_none("a move that is not the method's", wrong_move);
  require_none("a sum that is not the tally's", wrong_sum);
  return decisions;
}

template <class T>
struct TeamInput {
  int count;
  const std::int32_t* numbers;
  const std::int32_t* sizes;
  const std::uint8_t* active;
  const Point2<T>* points;
};

/// One vertex a team; every thread of it writes what it was told.
template <class Update, class T>
__global__ void evaluate_by_teams(TeamInput<T> input, trismooth::VertexMove<T>* results) {
  const int thread = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int i = thread / cuda::team_size;
  const bool active = i < input.count && input.active[i] != 0;
  const int own = active ? i : 0;
  const int size = active ? input.sizes[own] : 0;
  const Point2<T> position = input.points[input.numbers[own]];
  const RingView<T> ring{input.points + input.numbers[own] + 1, size};
  const trismooth::VertexMove<T> result = cuda::evaluate_by_team<Update>(
      position, size, [&](int n) { return ring[n]; }, [&] { return defined_update<Update>(position, ring); });
  if (i < input.count) {
    results[thread] = result;
  }
}

template <class Update, class T>
void check_by_teams(const Vertices<T>& vertices) {
  const PointList<T> list(vertices.all);
  const SharedArray<Point2<T>> points(list.points);
  const SharedArray<std::int32_t> numbers(list.numbers);
  const SharedArray<std::int32_t> sizes(list.sizes);
  const SharedArray<std::uint8_t> active(vertices.active);
  constexpr int threads = vertex_count * cuda::team_size;
  const SharedArray<trismooth::VertexMove<T>> results(threads);
  const TeamInput<T> input{vertex_count, numbers.data(), sizes.data(), active.data(), points.data()};
  evaluate_by_teams<Update><<<cuda::blocks_for(threads), cuda::block_size>>>(input, results.data());
  finish_launch();

  const std::vector<trismooth::VertexMove<T>> expected = defined_updates<Update>(vertices.all);
  Count idle_moves;
  Count wrong_move;
  Count wrong_sum;
  for (int thread = 0; thread < threads; ++thread) {
    const int i = thread / cuda::team_size;
    const auto place = static_cast<std::size_t>(i);
    const Move<T>& move = results[thread].move;
    if (vertices.active[place] == 0) {
      idle_moves.add(move.moved, i);
      continue;
    }
    wrong_move.add(!same_bits(move, expected[place].move), i);
    wrong_sum.add(move.moved && !same_bits(results[thread].squares, expected[place].squares), i);
  }
  require_none("a team without a vertex that moves one", idle_moves);
  require_none("a move that is not the method's", wrong_move);
  require_none("a sum that is not the tally's", wrong_sum);
}

template <class T>
__global__ void reciprocals(T* values) {
  if (threadIdx.x > 0) {
    values[threadIdx.x] = cuda::small_reciprocal<T>(static_cast<int>(threadIdx.x));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("what the filter decides is what the smart Laplacian does", "", float, double) {
  const Vertices<TestType> vertices(vertex_count, 1);
  const auto require_useful = [](const Decisions& decisions) {
    // One that never decides would never be wrong.
    CHECK(decisions.ordinary > vertex_count / 10);
    CHECK(decisions.decided_ordinary >= 0.95 * decisions.ordinary);
    CHECK(decisions.moved > vertex_count / 10);
    CHECK(decisions.stayed > vertex_count / 10);
    // The vertices are hard enough to ask for more than the filter can tell.
    CHECK(decisions.undecided_ties > vertex_count / 1000);
  };
  SECTION("records of 16 bits, points in one array") {
    require_useful(check_in_registers<SmartLaplacian, std::int16_t>(vertices));
  }
  SECTION("records of 32 bits, coordinates in two arrays") {
    require_useful(check_in_registers<SmartLaplacian, std::int32_t>(vertices));
  }
}

TEMPLATE_TEST_CASE("the Laplacian in registers is the Laplacian, and always decided", "", float, double) {
  const Vertices<TestType> vertices(vertex_count, 2);
  const Decisions decisions = check_in_registers<Laplacian, std::int16_t>(vertices);
  CHECK(decisions.undecided == 0);
  CHECK(check_in_registers<Laplacian, std::int32_t>(vertices).undecided == 0);
}

TEMPLATE_TEST_CASE("a team does what one thread does, with rings of every size", "", float, double) {
  const Vertices<TestType> vertices(vertex_count, 3);
  SECTION("smart Laplacian") {
    check_by_teams<SmartLaplacian>(vertices);
  }
  SECTION("Laplacian") {
    check_by_teams<Laplacian>(vertices);
  }
}

TEMPLATE_TEST_CASE("reciprocals of small numbers are those of a division", "", float, double) {
  constexpr int count = cuda::Reciprocals<TestType>::count;
  const SharedArray<TestType> values(count);
  reciprocals<<<1, count>>>(values.data());
  finish_launch();
  for (int n = 1; n < count; ++n) {
    CAPTURE(n);
    CHECK(same_bits(values[n], TestType(1) / static_cast<TestType>(n)));
  }
}
