// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/moving/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "trismooth/base/box.h"

namespace trismooth {

namespace {

using Edge = std::array<std::int32_t, 2>;

/// Twice the area of a triangle, and 0 where that is rounding: in a frame in which coordinates are below 1 differences
/// of them are known to 2^-52.
double area_beyond_rounding(Point2<double> a, Point2<double> b, Point2<double> c) {
  const Point2<double> along = b - a;
  const Point2<double> to = c - a;
  const double area = cross(along, to);
  const double rounding = 0x1p-50 * (std::abs(along.x) + std::abs(along.y) + std::abs(to.x) + std::abs(to.y));
  return std::abs(area) > rounding ? area : 0;
}

double dot(Point2<double> a, Point2<double> b) {
  return a.x * b.x + a.y * b.y;
}

/// Whether c and d are on one side of the line through a and b, and neither is on it.
bool are_on_one_side(double c, double d) {
  return (c > 0 && d > 0) || (c < 0 && d < 0);
}

/// Whether two edges that leave one point lie on each other: to rounding, or so nearly that Winding does not see which
/// of them comes first.
bool lie_on_each_other(Point2<double> from, Point2<double> a, Point2<double> b) {
  constexpr double nearly = 2e-9;
  const double along = dot(a - from, b - from);
  return along > 0 && (area_beyond_rounding(from, a, b) == 0 || std::abs(cross(a - from, b - from)) < nearly * along);
}

/// Whether edges on one line have a point in common.
bool meet_on_line(Point2<double> a, Point2<double> b, Point2<double> c, Point2<double> d) {
  const auto is_between = [](Point2<double> p, Point2<double> one, Point2<double> other) {
    return dot(one - p, other - p) <= 0;
  };
  return is_between(c, a, b) || is_between(d, a, b) || is_between(a, c, d);
}

enum class Meeting : std::uint8_t { none, touch, cross };

Meeting meeting_of(const Edge& one, const Edge& other, std::span<const Point2<double>> points) {
  const auto at = [&points](std::int32_t v) { return points[v]; };
  const auto touch_where = [](bool is_so) { return is_so ? Meeting::touch : Meeting::none; };
  for (const std::size_t i : {0, 1}) {
    for (const std::size_t j : {0, 1}) {
      if (one[i] == other[j]) {
        return touch_where(lie_on_each_other(at(one[i]), at(one[1 - i]), at(other[1 - j])));
      }
    }
  }
  const Point2<double> a = at(one[0]);
  const Point2<double> b = at(one[1]);
  const Point2<double> c = at(other[0]);
  const Point2<double> d = at(other[1]);
  const double c_beside = area_beyond_rounding(a, b, c);
  const double d_beside = area_beyond_rounding(a, b, d);
  const double a_beside = area_beyond_rounding(c, d, a);
  const double b_beside = area_beyond_rounding(c, d, b);
  if (a_beside == 0 && b_beside == 0 && c_beside == 0 && d_beside == 0) {
    return touch_where(meet_on_line(a, b, c, d));
  }
  if (are_on_one_side(c_beside, d_beside) || are_on_one_side(a_beside, b_beside)) {
    return Meeting::none;
  }
  return c_beside != 0 && d_beside != 0 && a_beside != 0 && b_beside != 0 ? Meeting::cross : Meeting::touch;
}

/// Edges, halved by where they are again and again, for those whose boxes meet to be found.
class EdgeTree {
 public:
  EdgeTree(std::span<const Edge> edges, std::span<const Point2<double>> points) : edges_(edges), points_(points) {
    order_.resize(edges.size());
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) {
      add_node(0, order_.size());
    }
  }

  /// At most so many pairs that meet.
  std::vector<MeetingEdges> meetings(std::size_t most) {
    most_ = most;
    if (!nodes_.empty()) {
      find(0, 0);
    }
    return std::move(found_);
  }

 private:
  static constexpr std::size_t few = 4;

  struct Node {
    Box box;
    std::size_t begin;
    std::size_t end;
    std::size_t first_half = 0;  ///< 0: it is not halved
    std::size_t second_half = 0;
  };

  std::size_t add_node(std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
      box.add(points_[edges_[order_[i]][0]]);
      box.add(points_[edges_[order_[i]][1]]);
    }
    const std::size_t number = nodes_.size();
    nodes_.push_back({box, begin, end});
    if (end - begin > few) {
      const bool is_wide = box.high.x - box.low.x >= box.high.y - box.low.y;
      const auto place = [&](std::int32_t e) {
        const Point2<double> a = points_[edges_[e][0]];
        const Point2<double> b = points_[edges_[e][1]];
        return std::pair(is_wide ? a.x + b.x : a.y + b.y, e);
      };
      const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
      const std::size_t middle = begin + (end - begin) / 2;
      std::ranges::nth_element(at(begin), at(middle), at(end), {}, place);
      const std::size_t first = add_node(begin, middle);
      const std::size_t second = add_node(middle, end);
      nodes_[number].first_half = first;
      nodes_[number].second_half = second;
    }
    return number;
  }

  /// Pairs of an edge of one node and one of the other; of one node with itself each pair once.
  void find(std::size_t one, std::size_t other) {
    const Node& a = nodes_[one];
    const Node& b = nodes_[other];
    if (found_.size() >= most_ || a.box.low.x > b.box.high.x || b.box.low.x > a.box.high.x ||
        a.box.low.y > b.box.high.y || b.box.low.y > a.box.high.y) {
      return;
    }
    const bool is_a_halved = a.first_half != 0;
    const bool is_b_halved = b.first_half != 0;
    if (!is_a_halved && !is_b_halved) {
      compare(a, b);
    } else if (one == other) {
      find(a.first_half, a.first_half);
      find(a.second_half, a.second_half);
      find(a.first_half, a.second_half);
    } else if (is_a_halved && (!is_b_halved || a.end - a.begin >= b.end - b.begin)) {
      find(a.first_half, other);
      find(a.second_half, other);
    } else {
      find(one, b.first_half);
      find(one, b.second_half);
    }
  }

  void compare(const Node& a, const Node& b) {
    for (std::size_t i = a.begin; i < a.end; ++i) {
      for (std::size_t j = std::max(b.begin, a.begin == b.begin ? i + 1 : 0); j < b.end && found_.size() < most_; ++j) {
        const Meeting meeting = meeting_of(edges_[order_[i]], edges_[order_[j]], points_);
        if (meeting != Meeting::none) {
          const auto [smaller, larger] = std::minmax(order_[i], order_[j]);
          found_.push_back({smaller, larger, meeting == Meeting::cross});
        }
      }
    }
  }

  std::span<const Edge> edges_;
  std::span<const Point2<double>> points_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
  std::size_t most_ = 0;
  std::vector<MeetingEdges> found_;
};

}  // namespace

std::vector<MeetingEdges> meeting_edges(std::span<const Edge> edges, std::span<const Point2<double>> points,
                                        std::size_t most) {
  std::vector<MeetingEdges> meetings = EdgeTree(edges, points).meetings(most);
  std::ranges::sort(meetings);
  return meetings;
}

}  // namespace trismooth
