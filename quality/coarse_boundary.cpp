// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/coarse_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "trismooth/base/hold.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/text/digits.h"

namespace trismooth {

namespace {

/// An edge between two vertices of the boundary, and a corner across from it of an element at it.
struct BoundaryEdge {
  std::int32_t low;
  std::int32_t high;
  std::int32_t apex;

  bool joins(const BoundaryEdge& other) const { return low == other.low && high == other.high; }
};

/// An edge from an apex.
struct Spoke {
  std::int32_t apex;
  std::int32_t end;
  double length;

  bool operator<(const Spoke& other) const {
    return std::tie(apex, length, end) < std::tie(other.apex, other.length, other.end);
  }
};

class BoundarySearch {
 public:
  BoundarySearch(const MeshView& view, std::span<const std::uint8_t> held, int threads)
      : view_(view), held_(held), workers_(threads) {}

  CoarseBoundary find() {
    collect_edges();
    collect_spokes();
    join_curves();
    return judge();
  }

 private:
  bool on_boundary(std::int32_t v) const { return (held_[static_cast<std::size_t>(v)] & hold::boundary) != 0; }

  double length(std::int32_t a, std::int32_t b) const {
    return std::sqrt(
        squared_length(view_.points[static_cast<std::size_t>(b)] - view_.points[static_cast<std::size_t>(a)]));
  }

  /// What look(element, found) finds, in any order.
  template <class Found, class Look>
  std::vector<Found> found_in_elements(const Look& look) {
    constexpr std::int64_t grain = 16384;
    return joined_lists<Found>(std::ssize(view_.elements), grain, workers_, look);
  }

  /// The edges of one element alone. Their ends are all on the boundary, so few others have to be looked at.
  void collect_edges() {
    auto candidates = found_in_elements<BoundaryEdge>([&](std::int64_t e, std::vector<BoundaryEdge>& found) {
      const auto corners = view_.elements[static_cast<std::size_t>(e)];
      if (std::ranges::count_if(corners, [this](std::int32_t v) { return on_boundary(v); }) < 2) {
        return;
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::int32_t a = corners[i];
        const std::int32_t b = next_corner(corners, i);
        if (on_boundary(a) && on_boundary(b)) {
          found.push_back({std::min(a, b), std::max(a, b), corners[(i + 2) % corners.size()]});
        }
      }
    });
    std::ranges::sort(candidates, [](const BoundaryEdge& a, const BoundaryEdge& b) {
      return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    for (std::size_t first = 0, next = 0; first < candidates.size(); first = next) {
      while (next < candidates.size() && candidates[next].joins(candidates[first])) {
        ++next;
      }
      if (next == first + 1) {
        edges_.push_back(candidates[first]);
      }
    }
  }

  /// The edges of every free vertex opposite of a boundary edge, each once: its elements go around it.
  void collect_spokes() {
    std::vector<std::uint8_t> is_apex(view_.points.size(), 0);
    for (const BoundaryEdge& edge : edges_) {
      const auto apex = static_cast<std::size_t>(edge.apex);
      is_apex[apex] = held_[apex] == 0 ? 1 : 0;
    }
    spokes_ = found_in_elements<Spoke>([&](std::int64_t element, std::vector<Spoke>& found) {
      const auto e = static_cast<std::size_t>(element);
      const auto corners = view_.elements[e];
      const bool is_reversed = !view_.reversed.empty() && view_.reversed[e] != 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (is_apex[static_cast<std::size_t>(corners[i])] != 0) {
          found.push_back(spoke(corners[i], is_reversed ? previous_corner(corners, i) : next_corner(corners, i)));
        }
      }
    });
    std::sort(spokes_.begin(), spokes_.end());
  }

  Spoke spoke(std::int32_t apex, std::int32_t end) const { return {apex, end, length(apex, end)}; }

  /// How many times longer the edge is than the median of what lies behind it; 0 where that is nothing. Takes the time
  /// of a search, however many edges an apex has.
  double ratio(const BoundaryEdge& edge) const {
    const auto begin = std::ranges::lower_bound(spokes_, edge.apex, {}, &Spoke::apex);
    const auto end = std::ranges::upper_bound(spokes_, edge.apex, {}, &Spoke::apex);
    const std::span<const Spoke> of_apex(begin, end);
    // Those to the edge's ends do not lie behind it.
    std::array<std::ptrdiff_t, 2> left_out{};
    std::ptrdiff_t count = 0;
    for (const std::int32_t corner : {edge.low, edge.high}) {
      const auto place = std::lower_bound(of_apex.begin(), of_apex.end(), spoke(edge.apex, corner));
      if (place != of_apex.end() && place->end == corner) {
        left_out[static_cast<std::size_t>(count++)] = place - of_apex.begin();
      }
    }
    const std::ptrdiff_t behind = std::ssize(of_apex) - count;
    if (behind <= 0) {
      return 0;
    }
    if (count == 2 && left_out[1] < left_out[0]) {
      std::swap(left_out[0], left_out[1]);
    }
    std::ptrdiff_t median = behind / 2;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      median += left_out[static_cast<std::size_t>(i)] <= median ? 1 : 0;
    }
    const double median_length = of_apex[static_cast<std::size_t>(median)].length;
    return median_length > 0 ? length(edge.low, edge.high) / median_length : 0;
  }

  /// Gives each boundary vertex the curve that it is on.
  void join_curves() {
    for (const BoundaryEdge& edge : edges_) {
      vertices_.insert(vertices_.end(), {edge.low, edge.high});
    }
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    curve_.resize(vertices_.size());
    std::iota(curve_.begin(), curve_.end(), std::size_t{0});
    for (const BoundaryEdge& edge : edges_) {
      curve_[curve_of(edge.low)] = curve_of(edge.high);
    }
  }

  std::size_t curve_of(std::int32_t vertex) {
    auto at = static_cast<std::size_t>(std::ranges::lower_bound(vertices_, vertex) - vertices_.begin());
    while (curve_[at] != at) {
      curve_[at] = curve_[curve_[at]];
      at = curve_[at];
    }
    return at;
  }

  CoarseBoundary judge() {
    struct Curve {
      double length = 0;
      double coarse_length = 0;
      double largest_ratio = 0;
      std::int64_t coarse_edges = 0;
    };
    std::vector<Curve> curves(vertices_.size());
    for (const BoundaryEdge& edge : edges_) {
      Curve& curve = curves[curve_of(edge.low)];
      const double edge_length = length(edge.low, edge.high);
      curve.length += edge_length;
      if (const double times = ratio(edge); times > coarse_ratio) {
        curve.coarse_length += edge_length;
        curve.largest_ratio = std::max(curve.largest_ratio, times);
        ++curve.coarse_edges;
      }
    }
    CoarseBoundary result;
    result.boundary_edges = static_cast<std::int64_t>(edges_.size());
    for (const Curve& curve : curves) {
      if (curve.coarse_edges > 0 && curve.coarse_length >= coarse_part * curve.length) {
        result.coarse_edges += curve.coarse_edges;
        result.largest_ratio = std::max(result.largest_ratio, curve.largest_ratio);
      }
    }
    return result;
  }

  const MeshView& view_;
  std::span<const std::uint8_t> held_;
  Workers workers_;
  std::vector<BoundaryEdge> edges_;     ///< of the boundary
  std::vector<Spoke> spokes_;           ///< by apex, and by length
  std::vector<std::int32_t> vertices_;  ///< of the boundary, ascending
  std::vector<std::size_t> curve_;      ///< of each of them: a forest of indices; a root stands for its curve
};

}  // namespace

CoarseBoundary find_coarse_boundary(const MeshView& view, std::span<const std::uint8_t> held, int threads) {
  return BoundarySearch(view, held, threads).find();
}

std::string describe(const CoarseBoundary& boundary) {
  return "boundary edges more than " + shortest_digits(coarse_ratio) +
         " times as long as those behind them: " + std::to_string(boundary.coarse_edges) + " of " +
         std::to_string(boundary.boundary_edges) + " (up to " + general_digits(boundary.largest_ratio, 3) +
         " times); elements there grow when vertices move, which can harm a solution though shapes get better";
}

}  // namespace trismooth
