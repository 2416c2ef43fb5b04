// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/growth_note.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"

namespace trismooth {

namespace {

/// The triangles around one vertex, which may be taken to lie elsewhere.
class Fan {
 public:
  Fan(const TriangleView& view, std::int32_t vertex) : view_(&view), vertex_(vertex) {
    for (std::size_t t = 0; t < view.elements.size(); ++t) {
      if (std::ranges::find(view.elements[t], vertex) != view.elements[t].end()) {
        triangles_.push_back(t);
      }
    }
  }

  std::size_t size() const { return triangles_.size(); }

  /// The mean of the neighbours, each of which is of two of the triangles.
  Point2<double> middle() const {
    Point2<double> sum{0, 0};
    for (const std::size_t t : triangles_) {
      for (const std::int32_t v : view_->elements[t]) {
        const Point2<double> point = view_->points[v];
        sum = v == vertex_ ? sum : Point2<double>{sum.x + point.x, sum.y + point.y};
      }
    }
    const double weight = 1 / (2 * static_cast<double>(size()));
    return {weight * sum.x, weight * sum.y};
  }

  double smallest_quotient(Point2<double> at) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size(); ++i) {
      smallest = std::min(smallest, shape_quotient(corners(i, at)));
    }
    return smallest;
  }

  /// Twice the area of one of them, and its share of the error.
  double area(std::size_t i, Point2<double> at) const { return std::abs(doubled_area(corners(i, at))); }
  double share(std::size_t i, Point2<double> at) const {
    const auto [a, b, c] = corners(i, at);
    return share_of_error(area(i, at), squared_length(b - a) + squared_length(c - b) + squared_length(a - c));
  }

 private:
  CornerPoints corners(std::size_t i, Point2<double> at) const {
    return points_of(canonical_corners(*view_, triangles_[i]),
                     [&](std::int32_t v) { return v == vertex_ ? at : view_->points[v]; });
  }

  const TriangleView* view_;
  std::int32_t vertex_;
  std::vector<std::size_t> triangles_;
};

/// The bound of the vertex, in the local unit of `before`.
double bound_of(const TriangleView& before, std::int32_t vertex, const QualityReport& report) {
  const Fan fan(before, vertex);
  const Point2<double> at = before.points[vertex];
  double largest_share = 0;
  double areas = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    largest_share = std::max(largest_share, fan.share(i, at));
    areas += fan.area(i, at);
  }
  const double mean_shape = report[Metric::shape].mean;
  MeanRatioMesh mesh{};
  mesh.mean_area = std::ldexp(2 * report[Metric::area].mean, -2 * before.exponent);
  mesh.allowance = 1.5 / std::pow(mean_shape, 5);
  return growth_bound(largest_share, areas / static_cast<double>(fan.size()), mesh);
}

}  // namespace

bool may_have_growth_note(const SmoothingOptions& options, const QualityReport& before) {
  return options.method == Method::mean_ratio && !options.aims_at_sizes() &&
         options.mean_ratio.target == TargetShape::uniform && before[Metric::shape].mean > 0;
}

WorstTriangle worst_with_free_corner(const TriangleView& view, std::span<const std::uint8_t> fixed,
                                     const std::function<bool(std::size_t)>& counts) {
  WorstTriangle worst;
  for (std::size_t t = 0; t < view.elements.size(); ++t) {
    const double quotient = shape_quotient(corner_points(view, t));
    if (quotient < worst.quotient && counts(t) && !all_are_fixed(view.elements[t], fixed)) {
      worst = {quotient, static_cast<std::int64_t>(t)};
    }
  }
  return worst;
}

std::string growth_note(const TriangleView& before, const TriangleView& now, std::int32_t vertex,
                        const QualityReport& report, double quotient, std::int64_t cell, std::int64_t number) {
  const Fan fan(now, vertex);
  const Point2<double> at = now.points[vertex];
  const Point2<double> to = fan.middle();
  const double shape_there = shape_constant * fan.smallest_quotient(to);
  if (!(shape_there > shape_constant * fan.smallest_quotient(at))) {
    return {};
  }
  // Shares are areas times squares of lengths.
  const double bound = std::ldexp(bound_of(before, vertex, report), 4 * (before.exponent - now.exponent));
  for (std::size_t i = 0; i < fan.size(); ++i) {
    if (fan.share(i, to) > bound && fan.share(i, to) > fan.share(i, at)) {
      return fmt::format(
          "the growth bound of mean-ratio keeps the worst element that could get better, of shape {:.3g} in cell {}: "
          "vertex {} may not go where its worst triangle would have {:.3g}, since another one would grow too large "
          "for the error of a solution; finer edges nearby help, and --method smart has no such bound",
          shape_constant * quotient, cell, number, shape_there);
    }
  }
  return {};
}

void note_growth_bound(RunState& run, const MeshView& mesh_before) {
  if (!may_have_growth_note(run.smoothing, run.result.before) || !run.mesh.elements.are_triangles()) {
    return;
  }
  const auto triangles_of = [](const MeshView& view) {
    return TriangleView{view.points, view.elements.triangles(), view.reversed, view.exponent};
  };
  const TriangleView before = triangles_of(mesh_before);
  const TriangleView now = triangles_of(run.view());
  const WorstTriangle worst = worst_with_free_corner(now, run.found.fixed, [](std::size_t) { return true; });
  if (worst.triangle < 0) {
    return;
  }
  for (const std::int32_t v : now.elements[worst.triangle]) {
    if (run.found.fixed[v] == 0) {
      if (std::string said =
              growth_note(before, now, v, run.result.before, worst.quotient, run.mesh.cells[worst.triangle], v);
          !said.empty()) {
        run.note(std::move(said));
        return;
      }
    }
  }
}

}  // namespace trismooth
