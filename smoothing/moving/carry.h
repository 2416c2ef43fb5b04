// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/base/host_device.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/systems/graph_view.h"
#include "trismooth/smoothing/systems/solve.h"

namespace trismooth {

/// As a complex number: `turn` times `edge`.
constexpr TRISMOOTH_HOST_DEVICE Point2<double> turned_by(Point2<double> turn, Point2<double> edge) {
  return {turn.x * edge.x - turn.y * edge.y, turn.x * edge.y + turn.y * edge.x};
}

/// Of length 1; `none` where there is no direction.
inline TRISMOOTH_HOST_DEVICE Point2<double> direction_of(Point2<double> p, Point2<double> none) {
  const double length = std::sqrt(squared_length(p));
  return length > 0 && length - length == 0 ? Point2<double>{p.x / length, p.y / length} : none;
}

/// A turn around `from`, as a complex number of length 1, after which that is at `to`.
struct RigidMotion {
  Point2<double> turn;
  Point2<double> from;
  Point2<double> to;

  TRISMOOTH_HOST_DEVICE Point2<double> operator()(Point2<double> p) const {
    return plus(p, plus(turned_by(turn - Point2<double>{1, 0}, p - from), to - from));
  }
};

/// In units that are 2^power times as small.
inline TRISMOOTH_HOST_DEVICE Point2<double> rescaled(Point2<double> p, int power) {
  return {local_frame_details::scaled(p.x, power), local_frame_details::scaled(p.y, power)};
}

/// What numbers beyond the range of double become.
inline TRISMOOTH_HOST_DEVICE Point2<double> finite_or_zero(Point2<double> p) {
  return p.x - p.x == 0 && p.y - p.y == 0 ? p : Point2<double>{0, 0};
}

/// How far a vertex has moved, as a length in the file, of whose local frame `exponent` is.
inline TRISMOOTH_HOST_DEVICE double length_of_move(Point2<double> before, Point2<double> now, int exponent) {
  const Point2<double> half{now.x / 2 - before.x / 2, now.y / 2 - before.y / 2};  // the whole may be beyond double
  return local_frame_details::scaled(std::sqrt(squared_length(rescaled(half, -exponent))), exponent + 1);
}

/// A carried vertex's link to a held one.
struct HeldLink {
  std::int32_t held;  ///< its place in Carrier::held()
  double weight;
};

/// What a Carrier knows of a mesh, in memory of the host or of a device.
struct CarryView {
  std::span<const LevelView> levels;  ///< of the host, wherever the rest is
  const std::int32_t* carried;        ///< see Carrier::carried()
  const std::int32_t* held;           ///< see Carrier::held()
  const std::int64_t* held_offsets;   ///< by carried vertex, into `held_links`
  const HeldLink* held_links;
  double held_weight;  ///< the sum of all of these

  std::int32_t size() const { return levels.front().graph.size; }
};

namespace carry_details {

/// What the held vertices pull at the turns of the carried ones, seen from their mean.
struct PullOfTurns {
  CarryView mesh;
  const Point2<double>* turns;  ///< of held vertices
  Point2<double> mean;
  Point2<double>* pull;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t i) const {
    Point2<double> sum{0, 0};
    for (std::int64_t k = mesh.held_offsets[i]; k < mesh.held_offsets[i + 1]; ++k) {
      sum = plus(sum, times(mesh.held_links[k].weight, turns[mesh.held_links[k].held] - mean));
    }
    pull[i] = sum;
  }
};

/// A carried vertex: how far it is turned, where it was, and where it goes as all that is held does.
struct Begin {
  const std::int32_t* carried;
  RigidMotion motion;
  const Point2<double>* change_of_turn;
  const Point2<double>* from;
  Point2<double>* turns;
  Point2<double>* carried_from;
  Point2<double>* carried_now;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t i) const {
    turns[i] = direction_of(plus(motion.turn, change_of_turn[i]), motion.turn);
    carried_from[i] = from[carried[i]];
    carried_now[i] = motion(carried_from[i]);
  }
};

/// By how much the edges of a carried vertex are not what they are to be: turned.
struct PullOfEdges {
  CarryView mesh;
  GraphView graph;
  const Point2<double>* turns;  ///< of carried vertices, as are the next two
  const Point2<double>* carried_from;
  const Point2<double>* carried_now;
  const Point2<double>* held_turns;  ///< of held vertices
  const Point2<double>* from;        ///< of all vertices, as is the next
  const Point2<double>* now;
  Point2<double>* pull;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t i) const {
    Point2<double> sum{0, 0};
    const auto add = [&](double weight, Point2<double> turn, Point2<double> there_from, Point2<double> there_now) {
      const Point2<double> wanted = turned_by(times(0.5, plus(turn, turns[i])), carried_from[i] - there_from);
      sum = plus(sum, times(weight, wanted - (carried_now[i] - there_now)));
    };
    for (std::int64_t k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
      const std::int32_t u = graph.linked[k];
      add(graph.weights[k], turns[u], carried_from[u], carried_now[u]);
    }
    for (std::int64_t k = mesh.held_offsets[i]; k < mesh.held_offsets[i + 1]; ++k) {
      const HeldLink link = mesh.held_links[k];
      const std::int32_t u = mesh.held[link.held];
      add(link.weight, held_turns[link.held], from[u], now[u]);
    }
    pull[i] = sum;
  }
};

struct Finish {
  const std::int32_t* carried;
  const Point2<double>* carried_now;
  const Point2<double>* change;
  Point2<double>* now;

  TRISMOOTH_HOST_DEVICE void operator()(std::int32_t i) const { now[carried[i]] = plus(carried_now[i], change[i]); }
};

}  // namespace carry_details

/// Puts the carried vertices of `now` to where they are carried; held ones are where they are to be. `from`: the mesh
/// to carry on from, in units of the same length; any frame. `motion`: of all that is held; `held_turns`: of each held
/// vertex; see Carrier::motion_of_held(). `rows`: HostRows, or what has its functions; all memory but that of `levels`
/// is where it works. Where no held vertex has moved `now` becomes `from` to the last bit, but for a translation, and
/// where all have moved as a rigid body it is `from` so moved, to rounding. The same bits wherever it works.
/// Complexity: linear in each of some ten steps.
template <class Rows>
void carry(const CarryView& mesh, const RigidMotion& motion, const Point2<double>* held_turns,
           const Point2<double>* from, Point2<double>* now, Rows& rows) {
  using namespace carry_details;
  const std::int32_t count = mesh.size();
  const auto zeros = [&] { return rows.template zeros<Point2<double>>(static_cast<std::size_t>(count)); };
  auto pull = zeros();
  rows.for_rows(count, PullOfTurns{mesh, held_turns, motion.turn, pull.data()});
  // Of the norm that it has where all that is held is turned by 1: then all is, and only links to what is held differ.
  constexpr double largest_error = 1e-4;
  auto change = zeros();
  solve(mesh.levels, change.data(), pull.data(), largest_error * std::sqrt(mesh.held_weight), rows);
  auto turns = zeros();
  auto carried_from = zeros();
  auto carried_now = zeros();
  rows.for_rows(
      count, Begin{mesh.carried, motion, change.data(), from, turns.data(), carried_from.data(), carried_now.data()});
  rows.for_rows(count, PullOfEdges{mesh, mesh.levels.front().graph, turns.data(), carried_from.data(),
                                   carried_now.data(), held_turns, from, now, pull.data()});
  change = zeros();
  // Weights are 1 / length^2: no edge is further from what it should be than this, as a part of its length.
  constexpr double largest_strain = 0.01;
  solve(mesh.levels, change.data(), pull.data(), largest_strain, rows);
  rows.for_rows(count, Finish{mesh.carried, carried_now.data(), change.data(), now});
}

}  // namespace trismooth
