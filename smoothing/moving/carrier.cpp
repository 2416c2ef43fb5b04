// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving/carrier.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace trismooth {

namespace {

/// The free vertices from which edges lead to a held one, by way of others; ascending.
std::vector<std::int32_t> tied_vertices(const RingView& rings) {
  std::vector<std::uint8_t> is_tied(static_cast<std::size_t>(rings.size()), 0);
  std::vector<std::int32_t> open;
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (rings.is_free(v) && std::ranges::any_of(rings[v], [&](std::int32_t u) { return !rings.is_free(u); })) {
      is_tied[v] = 1;
      open.push_back(v);
    }
  }
  while (!open.empty()) {
    const std::int32_t v = open.back();
    open.pop_back();
    for (const std::int32_t u : rings[v]) {
      if (rings.is_free(u) && is_tied[u] == 0) {
        is_tied[u] = 1;
        open.push_back(u);
      }
    }
  }
  std::vector<std::int32_t> tied;
  for (std::int32_t v = 0; v < rings.size(); ++v) {
    if (is_tied[v] != 0) {
      tied.push_back(v);
    }
  }
  return tied;
}

double weight_of(Point2<double> edge) {
  constexpr double no_length = 1e-24;  // squared, where a mesh is about 1 wide
  return 1 / std::max(squared_length(edge), no_length);
}

/// By what an edge has been multiplied, as a complex number.
Point2<double> turn_of(Point2<double> before, Point2<double> now) {
  return times(weight_of(before), turned_by({before.x, -before.y}, now));
}

}  // namespace

Carrier::Carrier(const RingView& rings, const ElementList& elements, std::span<const Point2<double>> points)
    : carried_(tied_vertices(rings)) {
  constexpr std::int32_t nowhere = -1;
  std::vector<std::int32_t> place(points.size(), nowhere);
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    place[carried_[i]] = static_cast<std::int32_t>(i);
  }
  for (const auto corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t a = std::min(corners[i], next_corner(corners, i));
      const std::int32_t b = std::max(corners[i], next_corner(corners, i));
      if (!rings.is_free(a) && !rings.is_free(b)) {
        edges_.push_back({a, b});
      }
    }
  }
  std::ranges::sort(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  for (const auto& [a, b] : edges_) {
    held_.insert(held_.end(), {a, b});
  }
  WeightedGraph graph;
  for (const std::int32_t v : carried_) {
    double sum = 0;
    for (const std::int32_t u : rings[v]) {
      const double weight = weight_of(points[u] - points[v]);
      sum += weight;
      if (place[u] != nowhere) {
        graph.linked.push_back(place[u]);
        graph.weights.push_back(weight);
      } else {
        held_.push_back(u);
        held_links_.push_back({u, weight});  // by its own number for now
        held_weight_ += weight;
      }
    }
    graph.diagonal.push_back(sum);
    graph.offsets.push_back(std::ssize(graph.linked));
    held_offsets_.push_back(std::ssize(held_links_));
  }
  laplacian_ = GraphLaplacian(std::move(graph));
  std::ranges::sort(held_);
  held_.erase(std::unique(held_.begin(), held_.end()), held_.end());
  for (std::size_t i = 0; i < held_.size(); ++i) {
    place[held_[i]] = static_cast<std::int32_t>(i);
  }
  for (HeldLink& link : held_links_) {
    link.held = place[link.held];
  }
  for (auto& [a, b] : edges_) {
    a = place[a];
    b = place[b];
  }
}

HeldMotion Carrier::motion_of_held(std::span<const Point2<double>> from, std::span<const Point2<double>> now) const {
  HeldMotion motion{{{0, 0}, {0, 0}, {0, 0}}, std::vector<Point2<double>>(held_.size(), {0, 0})};
  RigidMotion& all = motion.all;
  for (const auto& [a, b] : edges_) {
    const Point2<double> turn = turn_of(from[b] - from[a], now[b] - now[a]);
    motion.turns[a] = plus(motion.turns[a], turn);
    motion.turns[b] = plus(motion.turns[b], turn);
    const double part = 0.5 / static_cast<double>(edges_.size());
    all.turn = plus(all.turn, turn);
    all.from = plus(all.from, times(part, plus(from[a], from[b])));
    all.to = plus(all.to, times(part, plus(now[a], now[b])));
  }
  all.turn = direction_of(all.turn, {1, 0});
  // A held vertex by itself turns as all that is held does.
  for (Point2<double>& turn : motion.turns) {
    turn = direction_of(turn, all.turn);
  }
  return motion;
}

}  // namespace trismooth
