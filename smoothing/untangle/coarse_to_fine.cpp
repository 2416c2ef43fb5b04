// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/coarse_to_fine.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trismooth/base/machine/call_limit.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/rings/ring_elements.h"
#include "trismooth/smoothing/untangle/ring_kernel.h"
#include "trismooth/smoothing/untangle/tutte.h"
#include "trismooth/smoothing/untangle/untangling_newton.h"

namespace trismooth {

namespace {

/// Cuts each quadrilateral of a patch in two, so that no two edges have the same ends.
class CutQuadrilaterals {
 public:
  explicit CutQuadrilaterals(const Patch& patch) : patch_(patch), rings_(patch.rings()), cuts_(patch.elements.size()) {
    for (std::size_t e = 0; e < cuts_.size(); ++e) {
      const auto& [a, b, c, d] = patch.elements[e];
      if (d != no_corner) {
        cuts_[e] = !are_joined(a, c) ? Cut::from_first : !are_joined(b, d) ? Cut::from_second : Cut::none;
        are_cut_ = are_cut_ && cuts_[e] != Cut::none;
      }
    }
  }

  /// Whether there was a way for all of them.
  bool are_cut() const { return are_cut_; }

  /// The neighbours of a vertex that may move, counter-clockwise.
  std::vector<std::int32_t> ring(std::int32_t v) const {
    std::vector<std::int32_t> found;
    const auto add = [&](const auto& places) {
      found.push_back(rings_[v][static_cast<std::size_t>(places.next)]);
      if (const std::int32_t opposite = across(v, places); opposite != no_corner) {
        found.push_back(opposite);
      }
    };
    rings_.with_ring(v, [&](const auto& ring) {
      for_elements_around(
          ring, [](int place) { return place; }, add);
    });
    return found;
  }

 private:
  enum class Cut : std::uint8_t { none, from_first, from_second };

  /// The other end of the cut that ends at v, where there is one; places as for_elements_around() has them.
  std::int32_t across(std::int32_t v, const QuadrilateralCorner<int>& places) const {
    const auto e = static_cast<std::size_t>(patch_.elements_around(v)[static_cast<std::size_t>(places.next)]);
    const MixedElement& corners = patch_.elements[e];
    const bool is_even = corners[0] == v || corners[2] == v;
    return cuts_[e] == (is_even ? Cut::from_first : Cut::from_second) ? rings_.mixed(v)[places.opposite] : no_corner;
  }
  static std::int32_t across(std::int32_t /*v*/, const TriangleCorner<int>& /*places*/) { return no_corner; }

  /// Whether there is an edge between them yet, as far as a ring has it.
  bool are_joined(std::int32_t v, std::int32_t w) const {
    if (v >= patch_.free_count) {
      std::swap(v, w);
    }
    return v < patch_.free_count && std::ranges::count(ring(v), w) > 0;
  }

  const Patch& patch_;
  RingView rings_;
  std::vector<Cut> cuts_;  ///< of quadrilaterals; none of those that are still to be cut
  bool are_cut_ = true;
};

/// A collapse of `vertex` into ring.front(); `ring` is what was around the vertex, counter-clockwise.
struct Collapse {
  std::int32_t vertex = 0;
  std::vector<std::int32_t> ring;
};

/// The rings of a patch's free vertices in triangles, of which some have been collapsed into their neighbours.
class CollapsibleRings {
 public:
  CollapsibleRings(const Patch& patch, const CutQuadrilaterals& cut)
      : vertex_count_(patch.vertex_count()),
        alive_(patch.free_count),
        rings_(static_cast<std::size_t>(patch.free_count)),
        round_(static_cast<std::size_t>(patch.free_count), 0) {
    for (std::int32_t v = 0; v < patch.free_count; ++v) {
      rings_[v] = cut.ring(v);
    }
  }

  std::int32_t alive() const { return alive_; }
  bool can_undo() const { return !collapses_.empty(); }

  /// Collapses until `target` vertices are left, or none can be any more. In rounds, in each of which neighbours of
  /// collapsed vertices wait for the next, so that what is left is spread evenly.
  void collapse_to(std::int32_t target) {
    for (std::size_t largest_ring = 7; largest_ring <= 24 && alive_ > target;) {
      const std::int32_t before = alive_;
      ++round_number_;
      CallLimit::look();
      for (std::int32_t v = 0; v < static_cast<std::int32_t>(rings_.size()) && alive_ > target; ++v) {
        if (!rings_[v].empty() && round_[v] != round_number_) {
          collapse(v, largest_ring);
        }
      }
      if (before - alive_ < before / 50) {
        ++largest_ring;
      }
    }
  }

  /// Undoes the last collapse. Returns its vertex and ring, valid until the next call.
  const Collapse& undo() {
    last_ = std::move(collapses_.back());
    collapses_.pop_back();
    const auto& [v, ring] = last_;
    const std::int32_t u = ring.front();
    const std::size_t last = ring.size() - 1;
    std::vector<std::int32_t>& of_u = rings_[u];
    // ..., ring[1], ring[2], ..., ring[last], ... becomes ..., ring[1], v, ring[last], ...
    turn_to_front(of_u, ring[1]);
    of_u.erase(of_u.begin() + 1, of_u.begin() + static_cast<std::ptrdiff_t>(last) - 1);
    of_u.insert(of_u.begin() + 1, v);
    for (std::size_t i = 1; i <= last; ++i) {
      if (!is_free(ring[i])) {
        continue;
      }
      std::vector<std::int32_t>& of_w = rings_[ring[i]];
      const auto at = std::ranges::find(of_w, u);
      if (i == 1) {
        of_w.insert(at, v);
      } else if (i == last) {
        of_w.insert(at + 1, v);
      } else {
        *at = v;
      }
    }
    rings_[v] = ring;
    ++alive_;
    return last_;
  }

  template <class Visit>
  void for_each_ring(const Visit& visit) const {
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(rings_.size()); ++v) {
      if (!rings_[v].empty()) {
        visit(v, std::span<const std::int32_t>(rings_[v]));
      }
    }
  }

  /// The patch of what is left. Its vertices are those of the patch that this was made of.
  Patch patch() const {
    OneRings rings = OneRings::with_sizes(static_cast<std::int32_t>(rings_.size()),
                                          [&](std::int32_t v) { return static_cast<std::int64_t>(rings_[v].size()); });
    std::vector<std::int32_t> left;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(rings_.size()); ++v) {
      std::ranges::copy(rings_[v], rings.neighbours.begin() + rings.offsets[v]);
      if (!rings_[v].empty()) {
        left.push_back(v);
      }
    }
    const RingView view = rings.view();
    return PatchCutter(view, vertex_count_).cut(left);
  }

 private:
  bool is_free(std::int32_t v) const { return v < static_cast<std::int32_t>(rings_.size()); }

  static void turn_to_front(std::vector<std::int32_t>& ring, std::int32_t first) {
    std::rotate(ring.begin(), std::ranges::find(ring, first), ring.end());
  }

  /// Whether the edge from v to its neighbour number `at` may go: it is in two triangles alone, and no neighbour of
  /// both is left with less than three of its own.
  bool may_collapse(std::int32_t v, std::size_t at) const {
    const std::vector<std::int32_t>& ring = rings_[v];
    const std::size_t size = ring.size();
    const std::int32_t u = ring[at];
    for (std::size_t i = 1; i < size; ++i) {
      const std::int32_t w = ring[(at + i) % size];
      const bool is_beside = i == 1 || i + 1 == size;
      if (is_beside ? is_free(w) && rings_[w].size() <= 3 : std::ranges::find(rings_[u], w) != rings_[u].end()) {
        return false;
      }
    }
    return true;
  }

  /// Collapses v into the free neighbour that gets the smallest ring, where there is one.
  void collapse(std::int32_t v, std::size_t largest_ring) {
    const std::vector<std::int32_t>& ring = rings_[v];
    if (ring.size() < 3) {
      return;
    }
    std::size_t best = ring.size();
    std::size_t smallest = largest_ring + 1;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!is_free(ring[i])) {
        continue;
      }
      const std::size_t size = rings_[ring[i]].size() + ring.size() - 4;
      if (size < smallest && size >= 3 && may_collapse(v, i)) {
        best = i;
        smallest = size;
      }
    }
    if (best == ring.size()) {
      return;
    }
    Collapse made{v, ring};
    std::rotate(made.ring.begin(), made.ring.begin() + static_cast<std::ptrdiff_t>(best), made.ring.end());
    apply(made);
    collapses_.push_back(std::move(made));
  }

  void apply(const Collapse& made) {
    const auto& [v, ring] = made;
    const std::int32_t u = ring.front();
    const std::size_t last = ring.size() - 1;
    std::vector<std::int32_t>& of_u = rings_[u];
    // ..., ring[1], v, ring[last], ... becomes ..., ring[1], ring[2], ..., ring[last], ...
    turn_to_front(of_u, v);
    of_u.erase(of_u.begin());
    of_u.insert(of_u.end(), ring.begin() + 2, ring.begin() + static_cast<std::ptrdiff_t>(last));
    for (std::size_t i = 1; i <= last; ++i) {
      round_of(ring[i]);
      if (!is_free(ring[i])) {
        continue;
      }
      std::vector<std::int32_t>& of_w = rings_[ring[i]];
      const auto at = std::ranges::find(of_w, v);
      if (i == 1 || i == last) {
        of_w.erase(at);
      } else {
        *at = u;
      }
    }
    round_of(u);
    rings_[v].clear();
    --alive_;
  }

  void round_of(std::int32_t v) {
    if (is_free(v)) {
      round_[v] = round_number_;
    }
  }

  std::int32_t vertex_count_;
  std::int32_t alive_;
  std::vector<std::vector<std::int32_t>> rings_;  ///< empty where the vertex is gone
  std::vector<std::int32_t> round_;               ///< the last one in which something near the vertex collapsed
  std::int32_t round_number_ = 0;
  std::vector<Collapse> collapses_;
  Collapse last_;
};

/// The free vertices of the coarsest mesh: more where there are more held ones to go round.
constexpr std::int32_t coarsest = 1000;
constexpr std::int32_t coarsest_by_held = 2;
constexpr int coarsest_steps = 150;
constexpr int level_steps = 4;
constexpr int quadrilateral_steps = 100;
constexpr int smart_sweeps = 4;

/// A ring as methods read it.
struct RingOfPoints {
  std::span<const std::int32_t> numbers;
  std::span<const Point2<double>> points;

  int size() const { return static_cast<int>(numbers.size()); }
  Point2<double> operator[](int i) const { return points[numbers[i]]; }
};

/// The smart move, whole or half of it.
void move_to_mean_if_better(std::int32_t v, std::span<const std::int32_t> ring, std::span<Point2<double>> points) {
  Point2<double> mean{0, 0};
  for (const std::int32_t neighbour : ring) {
    mean.x += points[neighbour].x;
    mean.y += points[neighbour].y;
  }
  const auto count = static_cast<double>(ring.size());
  mean = {mean.x / count, mean.y / count};
  const Point2<double> half{0.5 * (mean.x + points[v].x), 0.5 * (mean.y + points[v].y)};
  const RingOfPoints positions{ring, points};
  const double now = worst_quotient(points[v], positions);
  for (const Point2<double> place : {mean, half}) {
    if (worst_quotient(place, positions) > now) {
      points[v] = place;
      return;
    }
  }
}

}  // namespace

void untangle_coarse_to_fine(const Patch& patch, std::span<Point2<double>> points, Workers& workers) {
  const CutQuadrilaterals cut(patch);
  if (!cut.are_cut()) {
    return;
  }
  CollapsibleRings rings(patch, cut);
  rings.collapse_to(coarsest + coarsest_by_held * (patch.vertex_count() - patch.free_count));
  std::vector<Point2<double>> level_points;
  const auto improve = [&](bool is_coarsest) {
    const Patch level = rings.patch();
    level_points.clear();
    for (const std::int32_t v : level.vertices) {
      level_points.push_back(points[v]);
    }
    if (is_coarsest) {
      constexpr double exact = 1e-10;
      tutte(level, level_points, exact, workers);
    }
    minimise_regularised(level, level_points, is_coarsest ? coarsest_steps : level_steps, workers);
    for (std::int32_t v = 0; v < level.free_count; ++v) {
      points[level.vertices[v]] = level_points[v];
    }
  };
  improve(true);
  std::vector<Point2<double>> around;
  std::vector<Point2<double>> scratch;
  while (rings.can_undo()) {
    CallLimit::look();
    for (std::int64_t until = 2 * std::int64_t{rings.alive()}; rings.can_undo() && rings.alive() < until;) {
      const auto& [v, ring] = rings.undo();
      around.clear();
      for (const std::int32_t neighbour : ring) {
        around.push_back(points[neighbour]);
      }
      const auto centre = kernel_centre(around, scratch);
      points[v] = centre ? *centre : points[ring.front()];
    }
    for (int sweep = 0; sweep < smart_sweeps; ++sweep) {
      CallLimit::look();
      rings.for_each_ring(
          [&](std::int32_t v, std::span<const std::int32_t> ring) { move_to_mean_if_better(v, ring, points); });
    }
    improve(false);
  }
  if (patch.rings().has_quadrilaterals()) {
    minimise_regularised(patch, points, quadrilateral_steps, workers);
  }
}

}  // namespace trismooth
