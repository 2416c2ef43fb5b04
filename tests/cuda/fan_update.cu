// SPDX-License-Identifier: BSD-3-Clause
// What the resident execution evaluates a vertex of four quadrilaterals with, in registers, by a team, without
// dividing: it has to do exactly what the method's own function says of the same ring.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <cuda_runtime.h>

#include "trismooth/cuda/runtime/launch.h"
#include "trismooth/cuda/update/quadrilateral_fan.cuh"
#include "trismooth/cuda/update/team_update.cuh"
#include "trismooth/cuda/update/vertex_update.cuh"
#include "trismooth/smoothing/methods/methods.h"

#include "catch.h"
#include "hard_rings.h"
#include "update_checks.h"

using namespace trismooth;
using hard_rings::Kind;
using hard_rings::Random;
using namespace update_checks;

namespace {

// No multiple of a warp.
constexpr int fan_count = 131072 + 13;

/// A vertex, its four neighbours, and the four vertices opposite; which elements are quadrilaterals.
template <class T>
struct Fan {
  Kind kind;
  Point2<T> points[9];
  bool is_quadrilateral[4];
};

/// Its ring, on the host or on the device.
template <class T>
struct FanRing {
  const Fan<T>* fan;

  constexpr TRISMOOTH_HOST_DEVICE int size() const { return 4; }
  constexpr TRISMOOTH_HOST_DEVICE Point2<T> operator[](int i) const { return fan->points[1 + i]; }
  constexpr TRISMOOTH_HOST_DEVICE bool is_quadrilateral(int i) const { return fan->is_quadrilateral[i]; }
};

/// Of a grid of squares that is turned and jittered.
template <class T>
Fan<T> of_grid(Random& random) {
  const double scale = hard_rings::random_scale<T>(random);
  const double turn = random.between(0, 2 * std::numbers::pi);
  const auto centre = hard_rings::random_point<T>(random);
  Fan<T> fan{Kind::ordinary, {}, {true, true, true, true}};
  const int columns[] = {0, 1, 0, -1, 0, 1, -1, -1, 1};
  const int rows[] = {0, 0, 1, 0, -1, 1, 1, -1, -1};
  const double most = random.between(0, 0.4);
  for (int i = 0; i < 9; ++i) {
    const double x = scale * (columns[i] + random.between(-most, most));
    const double y = scale * (rows[i] + random.between(-most, most));
    fan.points[i] = {static_cast<T>(centre.x + x * std::cos(turn) - y * std::sin(turn)),
                     static_cast<T>(centre.y + x * std::sin(turn) + y * std::cos(turn))};
  }
  return fan;
}

/// Of the points of a hard ring of eight, every other one a neighbour.
template <class T>
Fan<T> of_hard_ring(Kind kind, Random& random) {
  const hard_rings::Vertex<T> vertex = hard_rings::any<T>(kind, 8, random);
  Fan<T> fan{kind, {vertex.position}, {true, true, true, true}};
  for (std::size_t i = 0; i < 4; ++i) {
    fan.points[1 + i] = vertex.neighbours[2 * i];
    fan.points[5 + i] = vertex.neighbours[2 * i + 1];
  }
  return fan;
}

/// Puts the vertex near the mean of its neighbours, or where it is nearly as good as there.
template <class T>
void tie(Fan<T>& fan, Random& random) {
  const FanRing<T> ring{&fan};
  const Point2<T> mean = laplacian_position<T>(ring);
  const T at_mean = worst_quotient(mean, ring);
  Point2<T> better = mean;
  Point2<T> worse = fan.points[0];
  for (int i = 0; i < 60 && !hard_rings::one_in(random, 50); ++i) {
    const Point2<T> middle{(better.x + worse.x) / 2, (better.y + worse.y) / 2};
    (worst_quotient(middle, ring) >= at_mean ? better : worse) = middle;
  }
  fan.points[0] = hard_rings::nearly(worse, random);
  fan.kind = Kind::tied;
}

template <class T>
std::vector<Fan<T>> fans(std::uint64_t seed, bool with_triangles) {
  Random random(seed);
  std::vector<Fan<T>> all;
  for (int i = 0; i < fan_count; ++i) {
    const auto kind = static_cast<Kind>(random.below(hard_rings::kinds));
    const bool is_usual = kind == Kind::ordinary || kind == Kind::tied;
    Fan<T> fan = is_usual ? of_grid<T>(random) : of_hard_ring<T>(kind, random);
    if (kind == Kind::tied) {
      tie(fan, random);
    }
    for (bool& is_quadrilateral : fan.is_quadrilateral) {
      is_quadrilateral = !with_triangles || hard_rings::one_in(random, 2);
    }
    all.push_back(fan);
  }
  return all;
}

template <class T>
struct FanAttempt {
  trismooth::VertexMove<T> result;
  bool decided;
};

template <class Update, class T>
__global__ void try_fans(const Fan<T>* fans, FanAttempt<T>* attempts) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < fan_count) {
    cuda::QuadrilateralFan<T> ring;
    for (int k = 0; k < 8; ++k) {
      ring.points[k] = fans[i].points[1 + k];
    }
    attempts[i].decided = cuda::try_update(Update{}, fans[i].points[0], ring, attempts[i].result);
  }
}

/// One vertex a team; every thread of it writes what it was told.
template <class Update, class T>
__global__ void fans_by_teams(const Fan<T>* fans, trismooth::VertexMove<T>* results) {
  const int thread = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int i = thread / cuda::team_size;
  const FanRing<T> ring{&fans[i < fan_count ? i : 0]};
  const Point2<T> position = ring.fan->points[0];
  const trismooth::VertexMove<T> result =
      cuda::evaluate_by_team<Update>(position, i < fan_count ? 4 : 0, ring, [&] { return trismooth::VertexMove<T>{}; });
  if (i < fan_count) {
    results[thread] = result;
  }
}

template <class Update, class T>
trismooth::VertexMove<T> by_definition(const Fan<T>& fan) {
  const FanRing<T> ring{&fan};
  return {Update::template update<T>(fan.points[0], ring), sum_of_tally(fan.points[0], ring)};
}

struct FanDecisions {
  int usual = 0;
  int decided_usual = 0;
  int undecided_ties = 0;
  int moved = 0;
  int stayed = 0;
};

template <class Update, class T>
FanDecisions check_fans(std::uint64_t seed) {
  const std::vector<Fan<T>> all = fans<T>(seed, false);
  const SharedArray<Fan<T>> on_device(all);
  const SharedArray<FanAttempt<T>> attempts(all.size());
  try_fans<Update><<<cuda::blocks_for(fan_count), cuda::block_size>>>(on_device.data(), attempts.data());
  finish_launch();
  FanDecisions decisions;
  Count wrong_move;
  Count wrong_sum;
  for (int i = 0; i < fan_count; ++i) {
    const Fan<T>& fan = all[static_cast<std::size_t>(i)];
    const FanAttempt<T>& attempt = attempts[i];
    const trismooth::VertexMove<T> expected = by_definition<Update>(fan);
    wrong_move.add(attempt.decided && !same_bits(attempt.result.move, expected.move), i);
    wrong_sum.add(attempt.decided && !same_bits(attempt.result.squares, expected.squares), i);
    const bool is_usual = fan.kind == Kind::ordinary && worst_quotient(fan.points[0], FanRing<T>{&fan}) > T(0.01);
    decisions.usual += is_usual ? 1 : 0;
    decisions.decided_usual += is_usual && attempt.decided ? 1 : 0;
    decisions.undecided_ties += fan.kind == Kind::tied && !attempt.decided ? 1 : 0;
    decisions.moved += attempt.decided && attempt.result.move.moved ? 1 : 0;
    decisions.stayed += attempt.decided && !attempt.result.move.moved ? 1 : 0;
  }
  require_none("a move that is not the method's", wrong_move);
  require_none("a sum that is not the tally's", wrong_sum);
  return decisions;
}

template <class Update, class T>
void check_fans_by_teams(std::uint64_t seed, bool with_triangles) {
  const std::vector<Fan<T>> all = fans<T>(seed, with_triangles);
  const SharedArray<Fan<T>> on_device(all);
  constexpr int threads = fan_count * cuda::team_size;
  const SharedArray<trismooth::VertexMove<T>> results(threads);
  fans_by_teams<Update><<<cuda::blocks_for(threads), cuda::block_size>>>(on_device.data(), results.data());
  finish_launch();
  Count wrong_move;
  Count wrong_sum;
  for (int i = 0; i < fan_count; ++i) {
    const trismooth::VertexMove<T> expected = by_definition<Update>(all[static_cast<std::size_t>(i)]);
    for (int lane = 0; lane < cuda::team_size; ++lane) {
      const trismooth::VertexMove<T>& found = results[i * cuda::team_size + lane];
      wrong_move.add(!same_bits(found.move, expected.move), i);
      wrong_sum.add(found.move.moved && !same_bits(found.squares, expected.squares), i);
    }
  }
  require_none("a move that is not the method's", wrong_move);
  require_none("a sum that is not the tally's", wrong_sum);
}

}  // namespace

TEMPLATE_TEST_CASE("what the filter decides of four quadrilaterals is what the methods do", "", float, double) {
  const auto require_useful = [](const FanDecisions& decisions) {
    CHECK(decisions.usual > fan_count / 10);
    CHECK(decisions.decided_usual >= 0.99 * decisions.usual);
    CHECK(decisions.moved > fan_count / 20);
    CHECK(decisions.stayed > fan_count / 20);
  };
  const FanDecisions of_smart = check_fans<SmartLaplacian, TestType>(1);
  require_useful(of_smart);
  // The vertices are hard enough to ask for more than the filter can tell.
  CHECK(of_smart.undecided_ties > fan_count / 1000);
  require_useful(check_fans<WeightedLaplacian, TestType>(2));
}

TEMPLATE_TEST_CASE("the Laplacian of four quadrilaterals in registers is the Laplacian, and always decided", "", float,
                   double) {
  const FanDecisions decisions = check_fans<Laplacian, TestType>(3);
  CHECK(decisions.usual == decisions.decided_usual);
  CHECK(decisions.undecided_ties == 0);
}

TEMPLATE_TEST_CASE("a team does with quadrilaterals, and with triangles among them, what one thread does", "", float,
                   double) {
  for (const bool with_triangles : {false, true}) {
    check_fans_by_teams<SmartLaplacian, TestType>(4, with_triangles);
    check_fans_by_teams<WeightedLaplacian, TestType>(5, with_triangles);
    check_fans_by_teams<Laplacian, TestType>(6, with_triangles);
  }
}
