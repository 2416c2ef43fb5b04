// SPDX-License-Identifier: BSD-3-Clause
// The tally of moves on the device divides only where it has to: it has to be that of all moves, joined.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/sweeps/thread_tally.cuh"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

#include "catch.h"
#include "hard_rings.h"
#include "update_checks.h"

using namespace trismooth;
using hard_rings::Kind;
using hard_rings::Random;
using hard_rings::RingView;
using hard_rings::Vertex;
using namespace update_checks;

namespace {

/// The tally of one move.
template <class T, class Ring>
SweepTally<T> tally_of_move(Point2<T> from, Point2<T> to, const Ring& ring, T tolerance) {
  SweepTally<T> tally;
  add_move(tally, length_of_move(from, to, ring.size(), sum_of_tally(from, ring)), tolerance);
  return tally;
}

/// Moves that one thread tallies one after the other, `length` for each thread.
template <class T>
struct MoveSequences {
  static constexpr int count = 8192;
  static constexpr int length = 32;

  std::vector<Vertex<T>> from;
  std::vector<Point2<T>> to;
  std::vector<T> tolerances;  ///< of each sequence

  std::size_t place(int sequence, int i) const {
    return static_cast<std::size_t>(sequence) * length + static_cast<std::size_t>(i);
  }

  /// Of vertices of all kinds.
  static MoveSequences of_any_length(std::uint64_t seed) {
    Random random(seed);
    MoveSequences moves;
    for (int sequence = 0; sequence < count; ++sequence) {
      for (int i = 0; i < length; ++i) {
        const auto kind = static_cast<Kind>(random.below(hard_rings::kinds));
        Vertex<T> vertex = hard_rings::any<T>(kind, 1 + random.below(16), random);
        moves.to.push_back(laplacian_position<T>(vertex.ring()));
        moves.from.push_back(std::move(vertex));
      }
      moves.tolerances.push_back(static_cast<T>(std::pow(10, random.between(-9, 1))));
    }
    return moves;
  }

  /// Of relative lengths that differ in their last digits, on rings between 2^low and 2^high in size; the tolerance
  /// is as near.
  static MoveSequences of_nearly_one_length(int low, int high, std::uint64_t seed) {
    Random random(seed);
    MoveSequences moves;
    for (int sequence = 0; sequence < count; ++sequence) {
      const Vertex<T> star = hard_rings::star(Point2<T>{T(0), T(0)}, 1, 3 + random.below(10), random);
      const Point2<T> target = laplacian_position<T>(star.ring());
      for (int i = 0; i < length; ++i) {
        const T scale = std::ldexp(T(1), low + random.below(high - low + 1));
        const auto changed = [&](Point2<T> point) {
          const int x = random.below(3) - 1;
          const int y = random.below(3) - 1;
          return Point2<T>{hard_rings::moved_by_units(point.x, x) * scale,
                           hard_rings::moved_by_units(point.y, y) * scale};
        };
        Vertex<T> vertex = star;
        for (Point2<T>& neighbour : vertex.neighbours) {
          neighbour = changed(neighbour);
        }
        moves.from.push_back(std::move(vertex));
        moves.to.push_back(changed(target));
      }
      const auto tally = tally_of_move(star.position, target, star.ring(), T(0));
      moves.tolerances.push_back(
          hard_rings::moved_by_units(std::sqrt(tally.max_relative_squared), random.below(5) - 2));
    }
    return moves;
  }
};

template <class T>
struct TallyInput {
  const std::int32_t* numbers;
  const std::int32_t* sizes;
  const Point2<T>* points;
  const Point2<T>* to;
  const T* tolerances;
};

template <class T>
__global__ void tally_sequences(TallyInput<T> input, cuda::ThreadTally<T>* tallies) {
  using Moves = MoveSequences<T>;
  const int sequence = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (sequence >= Moves::count) {
    return;
  }
  cuda::ThreadTally<T> tally;
  for (int i = sequence * Moves::length; i < (sequence + 1) * Moves::length; ++i) {
    const Point2<T> from = input.points[input.numbers[i]];
    const RingView<T> ring{input.points + input.numbers[i] + 1, input.sizes[i]};
    trismooth::add_move(tally, length_of_move(from, input.to[i], ring.size(), sum_of_tally(from, ring)),
                        input.tolerances[sequence]);
  }
  tallies[sequence] = tally;
}

/// How many sequences are within their tolerance.
template <class T>
int check_tallies(const MoveSequences<T>& moves) {
  using Moves = MoveSequences<T>;
  const PointList<T> list(moves.from);
  const SharedArray<std::int32_t> numbers(list.numbers);
  const SharedArray<std::int32_t> sizes(list.sizes);
  const SharedArray<Point2<T>> points(list.points);
  const SharedArray<Point2<T>> to(moves.to);
  const SharedArray<T> tolerances(moves.tolerances);
  const SharedArray<cuda::ThreadTally<T>> tallies(Moves::count);
  const TallyInput<T> input{numbers.data(), sizes.data(), points.data(), to.data(), tolerances.data()};
  tally_sequences<<<cuda::blocks_for(Moves::count), cuda::block_size>>>(input, tallies.data());
  finish_launch();

  Count wrong_moved;
  Count wrong_tolerance;
  Count wrong_longest;
  int within = 0;
  for (int sequence = 0; sequence < Moves::count; ++sequence) {
    SweepTally<T> expected;
    for (int i = 0; i < Moves::length; ++i) {
      const std::size_t place = moves.place(sequence, i);
      const Vertex<T>& vertex = moves.from[place];
      expected.join(tally_of_move(vertex.position, moves.to[place], vertex.ring(),
                                  moves.tolerances[static_cast<std::size_t>(sequence)]));
    }
    const cuda::ThreadTally<T>& tally = tallies[sequence];
    wrong_moved.add(static_cast<std::int64_t>(tally.moved) != expected.moved, sequence);
    wrong_tolerance.add(tally.within_tolerance != expected.within_tolerance, sequence);
    wrong_longest.add(!same_bits(tally.max_relative_squared, expected.max_relative_squared), sequence);
    within += expected.within_tolerance ? 1 : 0;
  }
  require_none("a wrong number of moves", wrong_moved);
  require_none("within the tolerance or not", wrong_tolerance);
  require_none("not the longest move", wrong_longest);
  return within;
}

}  // namespace

TEMPLATE_TEST_CASE("a tally that spares divisions is that of all moves", "", float, double) {
  using Moves = MoveSequences<TestType>;
  constexpr bool is_float = hard_rings::is_float<TestType>;
  SECTION("of any length") {
    const int within = check_tallies(Moves::of_any_length(4));
    CHECK(within > Moves::count / 100);
    CHECK(within < Moves::count - Moves::count / 100);
  }
  SECTION("of nearly the same length") {
    check_tallies(Moves::of_nearly_one_length(-20, 0, 5));
  }
  SECTION("of nearly the same length, with squares that are subnormal or nothing") {
    check_tallies(Moves::of_nearly_one_length(is_float ? -75 : -538, is_float ? -60 : -510, 6));
  }
}
