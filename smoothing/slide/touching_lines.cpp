// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/slide/touching_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "trismooth/base/box.h"
#include "trismooth/base/point_squares.h"

namespace trismooth {

namespace {

/// Vertices, halved by where they are again and again, for those beside an edge to be found.
class VertexTree {
 public:
  /// `points` outlive it.
  VertexTree(std::span<const Point2<double>> points, std::vector<std::int32_t> vertices)
      : points_(points), vertices_(std::move(vertices)) {
    if (!vertices_.empty()) {
      add_box(0, vertices_.size());
    }
  }

  /// Calls visit(vertex) for all that are no farther from the edge than `distance`, and for some others.
  template <class Visit>
  void visit_beside(Point2<double> from, Point2<double> to, double distance, const Visit& visit) const {
    if (boxes_.empty()) {
      return;
    }
    const Point2<double> way = to - from;
    const Edge edge{from,
                    {1 / way.x, 1 / way.y},
                    {std::min(from.x, to.x) - distance, std::min(from.y, to.y) - distance},
                    {std::max(from.x, to.x) + distance, std::max(from.y, to.y) + distance},
                    distance};
    walk(0, 0, vertices_.size(), edge, visit);
  }

 private:
  static constexpr std::size_t few = 8;

  /// What is near an edge: within a box, and beside the line.
  struct Edge {
    Point2<double> from;
    Point2<double> inverse_way;
    Point2<double> low;
    Point2<double> high;
    double distance;
  };
  /// Around vertices. The box of their first half comes next, if there are more than few.
  struct VertexBox : Box {
    std::size_t second_half;

    bool meets(const Edge& edge) const {
      if (low.x > edge.high.x || high.x < edge.low.x || low.y > edge.high.y || high.y < edge.low.y) {
        return false;
      }
      // A short edge is hardly ever in the box that is around it, and not beside it.
      if (edge.high.x - edge.low.x <= high.x - low.x && edge.high.y - edge.low.y <= high.y - low.y) {
        return true;
      }
      // The parts of the edge, from 0 to 1, that are as far along each axis as the box.
      double first = 0;
      double last = 1;
      const auto cut = [&](double inverse_way, double to_low, double to_high) {
        if (std::isfinite(inverse_way)) {
          const auto [begin, end] = std::minmax({to_low * inverse_way, to_high * inverse_way});
          first = std::max(first, begin);
          last = std::min(last, end);
        }
      };
      cut(edge.inverse_way.x, low.x - edge.distance - edge.from.x, high.x + edge.distance - edge.from.x);
      cut(edge.inverse_way.y, low.y - edge.distance - edge.from.y, high.y + edge.distance - edge.from.y);
      return first <= last;
    }
  };

  Point2<double> point(std::int32_t v) const { return points_[static_cast<std::size_t>(v)]; }
  static std::size_t middle(std::size_t begin, std::size_t end) { return begin + (end - begin) / 2; }

  void add_box(std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
      box.add(point(vertices_[i]));
    }
    const auto& [low, high] = box;
    const std::size_t number = boxes_.size();
    boxes_.push_back({box, 0});
    if (end - begin <= few) {
      return;
    }
    const auto at = [this](std::size_t i) { return vertices_.begin() + static_cast<std::ptrdiff_t>(i); };
    const bool is_wide = high.x - low.x >= high.y - low.y;
    std::nth_element(at(begin), at(middle(begin, end)), at(end), [&](std::int32_t a, std::int32_t b) {
      return is_wide ? point(a).x < point(b).x : point(a).y < point(b).y;
    });
    add_box(begin, middle(begin, end));
    boxes_[number].second_half = boxes_.size();
    add_box(middle(begin, end), end);
  }

  template <class Visit>
  void walk(std::size_t number, std::size_t begin, std::size_t end, const Edge& edge, const Visit& visit) const {
    const VertexBox& box = boxes_[number];
    if (!box.meets(edge)) {
      return;
    }
    if (end - begin <= few) {
      std::for_each(vertices_.begin() + static_cast<std::ptrdiff_t>(begin),
                    vertices_.begin() + static_cast<std::ptrdiff_t>(end), visit);
      return;
    }
    walk(number + 1, begin, middle(begin, end), edge, visit);
    walk(box.second_half, middle(begin, end), end, edge, visit);
  }

  std::span<const Point2<double>> points_;
  std::vector<std::int32_t> vertices_;
  std::vector<VertexBox> boxes_;
};

class TouchingSearch {
 public:
  TouchingSearch(const Slidable& slidable, std::span<const Point2<double>> points)
      : slidable_(slidable), points_(points), places_(points.size()), reaches_(points.size(), unknown) {
    found_.at_edges.resize(points.size(), 0);
    std::iota(places_.begin(), places_.end(), 0);
    for (std::int32_t v = 0; v < slidable.vertex_count(); ++v) {
      if (slidable.may_slide(v)) {
        reaches_[index(v)] = reach(v);
        for (const std::int32_t next : slidable.neighbours[index(v)]) {
          if (!slidable.may_slide(next)) {  // what is around it is not known
            reaches_[index(next)] = std::min(reaches_[index(next)], reaches_[index(v)]);
          }
        }
      }
    }
  }

  TouchingLines run() {
    // Mostly nobody is in the place of another, which is seen on the way along the edges, too.
    if (!find_at_edges(false)) {
      std::ranges::fill(found_.at_edges, 0);
      find_places();
      find_at_edges(true);
    }
    return std::move(found_);
  }

 private:
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  static std::size_t index(std::int32_t v) { return static_cast<std::size_t>(v); }
  Point2<double> point(std::int32_t v) const { return points_[index(v)]; }
  double squared_distance(std::int32_t v, std::int32_t w) const { return squared_length(point(v) - point(w)); }
  bool is_held(std::int32_t v) const { return slidable_.is_free[index(v)] == 0; }

  /// How near others have to be for them to touch a vertex that may slide.
  double reach(std::int32_t v) const {
    const auto [a, b] = slidable_.neighbours[index(v)];
    const double on_line = std::min(squared_distance(v, a), squared_distance(v, b));
    double height = unknown;  // in its elements
    for (const ListedSide& side : slidable_.fans.around(v)) {
      const auto lower_to = [&](std::int32_t from, std::int32_t to) {
        const double twice_area = cross(point(from) - point(v), point(to) - point(v));
        height = std::min(height, std::abs(twice_area) / std::sqrt(squared_distance(from, to)));
      };
      if (side.opposite == no_corner) {
        lower_to(side.first, side.second);
      } else {
        lower_to(side.first, side.opposite);
        lower_to(side.opposite, side.second);
      }
    }
    return std::min(1e-3 * std::sqrt(on_line), 0.1 * height);
  }

  void find_places() {
    // Reaches, rounded up to powers of 4, so that few differ.
    sizes_.assign(points_.size(), unknown);
    std::vector<double> sizes;
    for (std::size_t v = 0; v < sizes_.size(); ++v) {
      if (reaches_[v] < unknown) {
        sizes_[v] = reaches_[v] > 0 ? std::ldexp(1.0, 2 * (std::ilogb(reaches_[v]) / 2 + 1)) : 0;
        if (std::ranges::find(sizes, sizes_[v]) == sizes.end()) {
          sizes.push_back(sizes_[v]);
        }
      }
    }
    std::ranges::sort(sizes);
    PointSquares squares(points_.size());
    // Those on no line come last: they look for others, but nobody has to look for them.
    for (const bool on_line : {true, false}) {
      for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
        if (is_held(v) && (reaches_[index(v)] < unknown) == on_line && !join(v, sizes, squares) && on_line) {
          squares.add(point(v), sizes_[index(v)], v);
        }
      }
    }
  }

  /// Joins a vertex with those in its place. Returns whether one of them has its size: whoever is in its place is found
  /// from that then.
  bool join(std::int32_t v, std::span<const double> sizes, const PointSquares& squares) {
    bool has_one_of_size = false;
    const double own = reaches_[index(v)];
    for (const double size : sizes) {
      squares.visit_near(point(v), std::min(own, size), size, [&](std::int32_t other) {
        if (!are_in_place(v, other)) {
          return;
        }
        has_one_of_size = has_one_of_size || sizes_[index(other)] == sizes_[index(v)];
        places_[index(v)] = std::min(places_[index(v)], places_[index(other)]);
        found_.together.push_back({other, v});
      });
    }
    return has_one_of_size;
  }

  /// False where vertices lie in the same place and `knows_places` does not say that these have been found: as soon as
  /// there are any.
  bool find_at_edges(bool knows_places) {
    std::vector<std::int32_t> firsts;
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (is_held(v) && places_[index(v)] == v) {
        firsts.push_back(v);
      }
    }
    const VertexTree tree(points_, std::move(firsts));
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      if (!slidable_.may_slide(v)) {
        continue;
      }
      for (const std::int32_t next : slidable_.neighbours[index(v)]) {
        if ((v < next || !slidable_.may_slide(next)) && find_beside(tree, v, next) && !knows_places) {
          return false;
        }
      }
    }
    for (std::int32_t v = 0; v < slidable_.vertex_count(); ++v) {
      found_.at_edges[index(v)] |= found_.at_edges[index(places_[index(v)])];
    }
    return true;
  }

  bool are_in_place(std::int32_t v, std::int32_t w) const {
    const double near = std::min(reaches_[index(v)], reaches_[index(w)]);
    return squared_distance(v, w) <= near * near;
  }

  /// Returns whether another vertex lies in the place of one of the edge's ends.
  bool find_beside(const VertexTree& tree, std::int32_t from, std::int32_t to) {
    const auto [near, far] = std::minmax(reaches_[index(from)], reaches_[index(to)]);
    const Point2<double> way = point(to) - point(from);
    const double squared = squared_length(way);
    const double length = std::sqrt(squared);
    bool has_met = false;
    // (Twice as far: what the tree says of an edge is rounded.)
    tree.visit_beside(point(from), point(to), 2 * far, [&, near = near](std::int32_t v) {
      if (v == places_[index(from)] || v == places_[index(to)]) {
        return;
      }
      has_met = has_met || are_in_place(v, from) || are_in_place(v, to);
      const Point2<double> off = point(v) - point(from);
      const double along = off.x * way.x + off.y * way.y;
      const double limit = std::min(near, reaches_[index(v)]) * length;
      if (along > 0 && along < squared && std::abs(cross(off, way)) <= limit) {
        found_.at_edges[index(v)] = found_.at_edges[index(from)] = found_.at_edges[index(to)] = 1;
      }
    });
    return has_met;
  }

  const Slidable& slidable_;
  std::span<const Point2<double>> points_;
  TouchingLines found_;
  std::vector<std::int32_t> places_;  ///< of each vertex: a vertex that is in the same place, the first as far as known
  std::vector<double> sizes_;         ///< of the squares that each is in
  std::vector<double> reaches_;       ///< of each vertex, `unknown` where it is at no edge of a line that is known
};

}  // namespace

TouchingLines find_touching_lines(const Slidable& slidable, std::span<const Point2<double>> points) {
  return TouchingSearch(slidable, points).run();
}

}  // namespace trismooth
