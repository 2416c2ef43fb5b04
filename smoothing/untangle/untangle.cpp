// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/untangle/untangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/rings/ring_elements.h"
#include "trismooth/smoothing/untangle/coarse_to_fine.h"
#include "trismooth/smoothing/untangle/patch.h"
#include "trismooth/smoothing/untangle/ring_kernel.h"
#include "trismooth/smoothing/untangle/tutte.h"
#include "trismooth/smoothing/untangle/untangling_newton.h"

namespace trismooth {

namespace {

constexpr std::int64_t counting_grain = 4096;

/// Calls visit(corner) for the elements around v, which is free.
template <class Visit>
void for_corners_at(const RingView& rings, std::int32_t v, const Visit& visit) {
  rings.with_ring(v, [&](const auto& ring) { for_elements_around(ring, visit); });
}

/// Calls visit(element) for every element around v whose free corner of the smallest number is v.
template <class Visit>
void for_own_elements(const RingView& rings, std::int32_t v, const Visit& visit) {
  if (!rings.is_free(v)) {
    return;
  }
  for_corners_at(rings, v, [&](const auto& corner) {
    if (corner.all([&](std::int32_t other) { return other > v || !rings.is_free(other); })) {
      visit(element_at(v, corner));
    }
  });
}

/// The shape quotient of an element in canonical order: from the corner on that the input numbers lowest. So it has the
/// same bits from every one of its vertices.
template <class Corners>
double quotient_of(const Corners& element, std::span<const Point2<double>> points, const RingView& rings) {
  return shape_quotient(points_of(from_smallest(element, [&](std::int32_t v) { return rings.input(v); }), points));
}

/// Elements of a shape below this are mended with the inverted ones, where they have come about by that: rounding is
/// enough to invert them again.
constexpr double weak_quotient = 1e-4 / shape_constant;

/// What is wrong with a set of elements.
struct Faults {
  std::int64_t inverted = 0;  ///< or degenerate
  std::int64_t weak = 0;      ///< nearly so, and worse than they came

  bool any() const { return inverted + weak > 0; }
  friend bool operator<(const Faults& a, const Faults& b) {
    return a.inverted != b.inverted ? a.inverted < b.inverted : a.weak < b.weak;
  }
  /// Counts an element by its quotient now and in the input.
  void count(double quotient, double input) {
    if (!(quotient > 0)) {
      ++inverted;
    } else if (quotient < weak_quotient && !(quotient >= input && input > 0)) {
      ++weak;
    }
  }
};

class Untangler {
 public:
  Untangler(const RingView& rings, std::span<Point2<double>> points, Workers& workers)
      : rings_(rings),
        points_(points),
        input_(points.begin(), points.end()),
        workers_(workers),
        listed_(points.size(), 0),
        cutter_(rings, static_cast<std::int32_t>(points.size())) {
    find_faulty();
  }

  UntangleOutcome run() {
    outcome_.inverted_before = faults_.inverted;
    try {
      mend();
    } catch (const CallEnded&) {
      // What is done by then is kept: between two parts the points are better than they were, if they have changed.
      CallLimit::lift_current();
      find_faulty();
    }
    outcome_.inverted_after = faults_.inverted;
    return outcome_;
  }

 private:
  void mend() {
    const auto move_to_means = [&](std::int32_t v) { move_to_mean(v); };
    const auto move_to_kernels = [&](std::int32_t v) { move_to_kernel(v); };
    move_corners(move_to_means, 12, outcome_.by_averages);
    move_corners(move_to_kernels, 4, outcome_.by_kernels);
    if (is_much()) {
      solve_parts(all_rings, Effort::embedding);
    }
    if (is_much()) {
      solve_parts(all_rings, Effort::refinement);
    }
    bool are_all = false;
    bool has_helped = true;
    for (std::int64_t rings = 2; faults_.any() && rings <= most_rings && !are_all && !is_much(); rings *= 4) {
      const Faults before = faults_;
      are_all = solve_parts(rings, Effort::energy);
      has_helped = faults_ < before;
    }
    // What is weak alone is not worth the whole mesh. Nor is, if that is large, what so many rings did nothing for: it
    // is fixed vertices that fold it.
    if (faults_.inverted > 0 && (has_helped || are_all || rings_.size() <= large_mesh)) {
      solve_parts(all_rings, Effort::all);
    }
  }

  /// What a part is worth.
  enum class Effort : std::uint8_t { embedding, refinement, energy, all };

  /// Where that many elements are faulty, a part of the mesh is hardly ever enough.
  bool is_much() const { return std::ssize(faulty_) > rings_.size() / 10; }

  static constexpr std::int32_t large_mesh = 50000;
  static constexpr std::int32_t large_patch = 3000;     ///< refinement is cheaper than the energy from here on
  static constexpr std::int32_t largest_patch = 30000;  ///< the energy is hopeless from here on
  static constexpr std::int64_t most_rings = 32;
  static constexpr std::int64_t all_rings = std::numeric_limits<std::int64_t>::max();

  template <class Corners>
  Faults faults_of(const Corners& element) const {
    Faults faults;
    if (const double now = quotient_of(element, points_, rings_); !(now >= weak_quotient)) {
      faults.count(now, quotient_of(element, input_, rings_));
    }
    return faults;
  }

  /// In the order of the input: nothing that is found may depend on how the rings are numbered.
  void sort_by_input(std::vector<std::int32_t>& vertices) const {
    std::ranges::sort(vertices, {}, [&](std::int32_t v) { return rings_.input(v); });
  }

  /// All faulty elements of the mesh.
  void find_faulty() {
    const auto look = [this](std::int64_t v, std::vector<MixedElement>& found) {
      for_own_elements(rings_, static_cast<std::int32_t>(v), [&](const auto& element) {
        if (faults_of(element).any()) {
          found.push_back(as_mixed(element));
        }
      });
    };
    faulty_ = joined_lists<MixedElement>(rings_.size(), counting_grain, workers_, look);
    count_faults();
  }

  /// Of the faulty elements of now.
  void count_faults() {
    faults_ = {};
    for (const MixedElement& element : faulty_) {
      const Faults own = with_kind(element, [this](const auto& corners) { return faults_of(corners); });
      faults_.inverted += own.inverted;
      faults_.weak += own.weak;
    }
  }

  /// The free corners of the faulty elements, each once, in the order of the input.
  std::vector<std::int32_t> corners() {
    std::vector<std::int32_t> found;
    for (const std::span<const std::int32_t> element : ElementList(faulty_)) {
      for (const std::int32_t v : element) {
        if (rings_.is_free(v) && listed_[v] == 0) {
          listed_[v] = 1;
          found.push_back(v);
        }
      }
    }
    unlist(found);
    sort_by_input(found);
    return found;
  }

  void unlist(std::span<const std::int32_t> vertices) {
    for (const std::int32_t v : vertices) {
      listed_[v] = 0;
    }
  }

  /// The faulty elements around `moved` vertices, which were the corners of all faulty ones.
  void find_faulty_around(std::span<const std::int32_t> moved) {
    for (const std::int32_t v : moved) {
      listed_[v] = 1;
    }
    faulty_.clear();
    for (const std::int32_t v : moved) {
      for_corners_at(rings_, v, [&](const auto& corner) {
        const auto element = element_at(v, corner);
        if (corner.all([&](std::int32_t other) { return other > v || listed_[other] == 0; }) &&
            faults_of(element).any()) {
          faulty_.push_back(as_mixed(element));
        }
      });
    }
    count_faults();
    unlist(moved);
  }

  void move_to_mean(std::int32_t v) {
    const auto ring = rings_[v];
    Point2<double> sum{0, 0};
    for (const std::int32_t neighbour : ring) {
      sum.x += points_[neighbour].x;
      sum.y += points_[neighbour].y;
    }
    const auto count = static_cast<double>(ring.size());
    points_[v] = {sum.x / count, sum.y / count};
  }

  /// Whether the element around v is valid, as far as v decides it.
  bool is_valid_at(std::int32_t v, const TriangleCorner<std::int32_t>& corner) const {
    return quotient_of(element_at(v, corner), points_, rings_) > 0;
  }
  bool is_valid_at(std::int32_t v, const QuadrilateralCorner<std::int32_t>& corner) const {
    const auto [next, opposite, previous] = corner;
    // Of its opposite corner it is the other vertices that decide.
    return turns_left(previous, v, next) && turns_left(v, next, opposite) && turns_left(opposite, previous, v);
  }
  bool turns_left(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return cross(points_[b] - points_[a], points_[c] - points_[b]) > 0;
  }
  bool are_valid_at(std::int32_t v) const {
    bool are_valid = true;
    for_corners_at(rings_, v, [&](const auto& corner) { are_valid = are_valid && is_valid_at(v, corner); });
    return are_valid;
  }

  /// Adds to the ring what the place of the vertex has to see from the left for an element.
  void add_edges(const TriangleCorner<std::int32_t>& corner) { ring_points_.push_back(points_[corner.next]); }
  void add_edges(const QuadrilateralCorner<std::int32_t>& corner) {
    ring_points_.push_back(points_[corner.next]);
    ring_points_.push_back(points_[corner.opposite]);
    chords_.push_back({points_[corner.next], points_[corner.previous]});
  }

  void move_to_kernel(std::int32_t v) {
    if (are_valid_at(v)) {
      return;
    }
    ring_points_.clear();
    chords_.clear();
    for_corners_at(rings_, v, [this](const auto& corner) { add_edges(corner); });
    const auto centre = kernel_centre(ring_points_, scratch_, chords_);
    if (!centre) {
      return;
    }
    const Point2<double> old = points_[v];
    points_[v] = *centre;
    if (!are_valid_at(v)) {
      points_[v] = old;
    }
  }

  /// Moves the corners of faulty elements, one after the other, for some passes, and keeps the best of them.
  template <class Move>
  void move_corners(const Move& move, int most_passes, std::int64_t& mended) {
    if (!faults_.any()) {
      return;
    }
    const std::int64_t before = faults_.inverted;
    std::vector<Point2<double>> best_points(points_.begin(), points_.end());
    std::vector<MixedElement> best = faulty_;
    Faults fewest = faults_;
    int passes_in_vain = 0;
    for (int pass = 0; pass < most_passes && faults_.any() && passes_in_vain < 2 && !CallLimit::is_over(); ++pass) {
      const std::vector<std::int32_t> moved = corners();
      for (const std::int32_t v : moved) {
        move(v);
      }
      find_faulty_around(moved);
      ++passes_in_vain;
      if (faults_ < fewest) {
        best = faulty_;
        fewest = faults_;
        best_points.assign(points_.begin(), points_.end());
        passes_in_vain = 0;
      }
    }
    std::ranges::copy(best_points, points_.begin());
    faulty_ = std::move(best);
    faults_ = fewest;
    mended += before - faults_.inverted;
  }

  /// Cuts out the parts of the mesh within `rings` of faulty elements and solves each by itself. Returns whether they
  /// could not have been larger.
  bool solve_parts(std::int64_t rings, Effort effort) {
    std::vector<std::int32_t> near = corners();
    for (const std::int32_t v : near) {
      listed_[v] = 1;
    }
    std::size_t expanded = 0;
    bool are_all = false;
    for (std::int64_t ring = 0; ring < rings && !are_all; ++ring) {
      const std::size_t end = near.size();
      for (; expanded < end; ++expanded) {
        rings_.for_vertices_around(near[expanded], [&](std::int32_t other) {
          if (rings_.is_free(other) && listed_[other] == 0) {
            listed_[other] = 1;
            near.push_back(other);
          }
        });
      }
      are_all = near.size() == end;
    }
    // Parts that do not hang together are solved apart: listed_ is 1 for who waits for a part.
    std::vector<std::int32_t> part;
    for (const std::int32_t seed : near) {
      if (listed_[seed] != 1 || CallLimit::is_over()) {
        continue;
      }
      part.assign(1, seed);
      listed_[seed] = 2;
      for (std::size_t i = 0; i < part.size(); ++i) {
        rings_.for_vertices_around(part[i], [&](std::int32_t other) {
          if (listed_[other] == 1) {
            listed_[other] = 2;
            part.push_back(other);
          }
        });
      }
      solve(part, effort);
    }
    unlist(near);
    find_faulty();
    return are_all;
  }

  /// What is wrong with the patch where its points are `points`; `input`: the quotients of its elements in the input.
  Faults faults_of(const Patch& patch, std::span<const Point2<double>> points, std::span<const double> input) const {
    Faults faults;
    for (std::size_t e = 0; e < input.size(); ++e) {
      faults.count(quotient_at(patch.elements[e], points), input[e]);
    }
    return faults;
  }

  /// Whether the elements of the patch have a positive area in all: the held vertices alone decide that.
  static bool has_area(const Patch& patch, std::span<const Point2<double>> points) {
    double sum = 0;
    double size = 0;
    for (const MixedElement& element : patch.elements) {
      const double area =
          with_kind(element, [&](const auto& corners) { return doubled_area(points_of(corners, points)); });
      sum += area;
      size += std::abs(area);
    }
    return sum > no_area * size;
  }

  /// Solves one part and keeps the result where less is wrong with it.
  void solve(std::span<const std::int32_t> part, Effort effort) {
    const Patch patch = cutter_.cut(part);
    if (patch.vertex_count() == patch.free_count) {
      return;  // nothing holds it: a closed surface, laid flat
    }
    std::vector<Point2<double>> points;
    for (const std::int32_t v : patch.vertices) {
      points.push_back(points_[v]);
    }
    if (!has_area(patch, points)) {
      outcome_.parts_of_no_area += effort == Effort::all ? 1 : 0;
      return;
    }
    std::vector<double> input;
    for (const MixedElement& element : patch.elements) {
      input.push_back(quotient_at(element, [&](std::int32_t v) { return input_[patch.vertices[v]]; }));
    }
    const Faults before = faults_of(patch, points, input);
    std::vector<Point2<double>> best = points;
    Faults fewest = before;
    const auto keep_if_better = [&](const std::vector<Point2<double>>& found, std::int64_t& mended) {
      const Faults faults = faults_of(patch, found, input);
      if (faults < fewest) {
        mended += fewest.inverted - faults.inverted;
        fewest = faults;
        best = found;
      }
      return faults.any();
    };
    std::vector<Point2<double>> embedded = points;
    bool is_faulty = true;
    tutte(patch, embedded, rough_embedding, workers_);
    is_faulty = keep_if_better(embedded, outcome_.by_embedding);
    if (is_faulty && effort != Effort::embedding) {
      tutte(patch, embedded, exact_embedding, workers_);
      is_faulty = keep_if_better(embedded, outcome_.by_embedding);
    }
    if (is_faulty && effort != Effort::embedding && (patch.free_count > large_patch || effort == Effort::refinement)) {
      std::vector<Point2<double>> refined = embedded;
      untangle_coarse_to_fine(patch, refined, workers_);
      is_faulty = keep_if_better(refined, outcome_.by_energy);
    }
    const std::int32_t largest = effort == Effort::all ? largest_patch : effort == Effort::energy ? large_patch : 0;
    if (is_faulty && patch.free_count <= largest) {
      minimise_regularised(patch, embedded, most_newton_steps, workers_);
      is_faulty = keep_if_better(embedded, outcome_.by_energy);
    }
    if (is_faulty && fewest.inverted > 0 && patch.free_count <= largest && effort == Effort::all) {
      std::vector<Point2<double>> lowered = points;
      minimise_regularised(patch, lowered, most_newton_steps, workers_);
      keep_if_better(lowered, outcome_.by_energy);
    }
    if (fewest < before) {
      for (std::size_t v = 0; v < part.size(); ++v) {
        points_[part[v]] = best[v];
      }
    }
  }

  static constexpr double rough_embedding = 1e-6;
  static constexpr double exact_embedding = 1e-11;
  static constexpr int most_newton_steps = 100;

  const RingView& rings_;
  std::span<Point2<double>> points_;
  std::vector<Point2<double>> input_;
  Workers& workers_;
  UntangleOutcome outcome_;
  std::vector<MixedElement> faulty_;  ///< the faulty elements of now
  Faults faults_;                     ///< their number
  std::vector<std::uint8_t> listed_;  ///< marks of vertices, 0 between two uses
  PatchCutter cutter_;
  std::vector<Point2<double>> ring_points_;
  std::vector<Chord> chords_;
  std::vector<Point2<double>> scratch_;
};

}  // namespace

std::int64_t inverted_elements(const RingView& rings, std::span<const Point2<double>> points, Workers& workers) {
  return joined_sum(rings.size(), counting_grain, workers, [&](std::int64_t v) {
    std::int64_t inverted = 0;
    for_own_elements(rings, static_cast<std::int32_t>(v),
                     [&](const auto& element) { inverted += quotient_of(element, points, rings) > 0 ? 0 : 1; });
    return inverted;
  });
}

std::int64_t inverted_elements_of_part(const PackedRings& rings, std::span<const Point2<double>> points) {
  const RingView view = rings.view();
  std::int64_t inverted = 0;
  for (std::int32_t v = 0; v < rings.free_count(); ++v) {
    const auto count = [&](const auto& corner) {
      const bool is_own = corner.all(
          [&](std::int32_t other) { return other >= rings.first_fixed() || view.input(other) > view.input(v); });
      inverted += is_own && !(quotient_of(element_at(v, corner), points, view) > 0) ? 1 : 0;
    };
    view.with_ring(v, [&](const auto& ring) { for_elements_around(ring, count); });
  }
  return inverted;
}

UntangleOutcome untangle(const RingView& rings, std::span<Point2<double>> points, Workers& workers) {
  if (inverted_elements(rings, points, workers) == 0) {
    return {};
  }
  return Untangler(rings, points, workers).run();
}

}  // namespace trismooth
