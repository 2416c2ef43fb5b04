// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/longitudes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace trismooth {

namespace {

/// Sets of vertices whose turns are known relative to each other.
class TurnSets {
 public:
  explicit TurnSets(std::size_t vertices) : parents_(vertices), turns_(vertices, 0), round_(vertices, 0) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  /// `b` makes `more` turns more than `a`.
  void join(std::int32_t a, std::int32_t b, std::int32_t more) {
    const auto [root_a, of_a] = find(a);
    const auto [root_b, of_b] = find(b);
    const std::int32_t difference = of_a + more - of_b;  // of the roots
    if (root_a == root_b) {
      round_[place(root_a)] |= static_cast<std::uint8_t>(difference != 0);
      return;
    }
    const bool goes_round = round_[place(root_a)] != 0 || round_[place(root_b)] != 0;
    const std::int32_t root = std::min(root_a, root_b);
    const std::int32_t child = std::max(root_a, root_b);
    parents_[place(child)] = root;
    turns_[place(child)] = child == root_b ? difference : -difference;
    round_[place(root)] = static_cast<std::uint8_t>(goes_round);
  }

  /// The turns of a vertex relative to the lowest of its set; 0 where that goes round the globe.
  std::int32_t turns_of(std::int32_t vertex) {
    const auto [root, turns] = find(vertex);
    return round_[place(root)] != 0 ? 0 : turns;
  }

 private:
  static std::size_t place(std::int32_t vertex) { return static_cast<std::size_t>(vertex); }

  /// The root of a vertex and its turns relative to that. Halves the way there.
  std::pair<std::int32_t, std::int32_t> find(std::int32_t vertex) {
    std::int32_t turns = 0;
    while (parents_[place(vertex)] != vertex) {
      const std::int32_t parent = parents_[place(vertex)];
      turns_[place(vertex)] += parents_[place(parent)] == parent ? 0 : turns_[place(parent)];
      parents_[place(vertex)] = parents_[place(parent)];
      turns += turns_[place(vertex)];
      vertex = parents_[place(vertex)];
    }
    return {vertex, turns};
  }

  std::vector<std::int32_t> parents_;
  std::vector<std::int32_t> turns_;  ///< relative to the parent
  std::vector<std::uint8_t> round_;  ///< of roots: 1 where the set goes round the globe
};

}  // namespace

UnwrappedLongitudes unwrap_longitudes(std::span<const double> longitudes, const ElementList& elements) {
  UnwrappedLongitudes result{std::vector<std::int32_t>(longitudes.size(), 0), {}};
  const auto jump = [&](std::int32_t a, std::int32_t b) {
    const double difference = longitudes[b] - longitudes[a];
    const auto turns = static_cast<std::int32_t>(std::ceil(std::max(0.0, std::abs(difference) - 180) / 360));
    return difference > 0 ? -turns : turns;
  };
  const auto any_side = [](std::span<const std::int32_t> corners, const auto& holds) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (holds(corners[i], next_corner(corners, i))) {
        return true;
      }
    }
    return false;
  };
  const auto jumps = [&](std::int32_t a, std::int32_t b) { return jump(a, b) != 0; };
  if (std::none_of(elements.begin(), elements.end(), [&](auto corners) { return any_side(corners, jumps); })) {
    return result;
  }
  TurnSets sets(longitudes.size());
  for (const auto corners : elements) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::int32_t a = corners[i];
      const std::int32_t b = next_corner(corners, i);
      sets.join(a, b, jump(a, b));
    }
  }
  for (std::size_t v = 0; v < longitudes.size(); ++v) {
    result.turns[v] = sets.turns_of(static_cast<std::int32_t>(v));
  }
  const auto is_cut = [&](std::int32_t a, std::int32_t b) { return result.turns[b] - result.turns[a] != jump(a, b); };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (any_side(elements[e], is_cut)) {
      result.cut.push_back(static_cast<std::int32_t>(e));
    }
  }
  return result;
}

}  // namespace trismooth
