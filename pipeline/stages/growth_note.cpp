#include "trismooth/pipeline/stages/growth_note.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/triangle_quality.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"

namespace trismooth {

namespace {

/// The triangles around one vertex, which may be taken to lie elsewhere.
class Fan {
 public:
  Fan(const TriangleView& view, std::int32_t vertex) : view_(&view), vertex_(vertex) {
    for (std::size_t t = 0; t < view.triangles.size(); ++t) {
      if (std::ranges::find(view.triangles[t], vertex) != view.triangles[t].end()) {
        triangles_.push_back(t);
      }
    }
  }

  std::size_t size() const { return triangles_.size(); }

  /// The mean of the neighbours, each of which is of two of the triangles.
  Point2<double> middle() const {
    Point2<double> sum{0, 0};
    for (const std::size_t t : triangles_) {
      for (const std::int32_t v : view_->triangles[t]) {
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
      const auto [a, b, c] = corners(i, at);
      smallest = std::min(smallest, shape_quotient(a, b, c));
    }
    return smallest;
  }

  /// Twice the area of one of them, and its share of the error.
  double doubled_area(std::size_t i, Point2<double> at) const {
    const auto [a, b, c] = corners(i, at);
    return std::abs(cross(b - a, c - a));
  }
  double share(std::size_t i, Point2<double> at) const {
    const auto [a, b, c] = corners(i, at);
    return share_of_error(doubled_area(i, at), squared_length(b - a) + squared_length(c - b) + squared_length(a - c));
  }

 private:
  std::array<Point2<double>, 3> corners(std::size_t i, Point2<double> at) const {
    const auto place = [&](std::int32_t v) { return v == vertex_ ? at : view_->points[v]; };
    const auto [a, b, c] = canonical_corners(*view_, triangles_[i]);
    return {place(a), place(b), place(c)};
  }

  const TriangleView* view_;
  std::int32_t vertex_;
  std::vector<std::size_t> triangles_;
};

/// The triangle of the smallest shape that has a free corner.
std::optional<std::size_t> worst_with_free_corner(const TriangleView& view, std::span<const std::uint8_t> fixed) {
  std::optional<std::size_t> worst;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < view.triangles.size(); ++t) {
    const auto [a, b, c] = corner_points(view, t);
    const double quotient = shape_quotient(a, b, c);
    if (quotient < smallest &&
        std::ranges::any_of(view.triangles[t], [fixed](std::int32_t v) { return fixed[v] == 0; })) {
      smallest = quotient;
      worst = t;
    }
  }
  return worst;
}

/// The bound of the vertex, in the local unit of `before`.
double bound_of(const TriangleView& before, std::int32_t vertex, const QualityReport& report) {
  const Fan fan(before, vertex);
  const Point2<double> at = before.points[vertex];
  double largest_share = 0;
  double areas = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    largest_share = std::max(largest_share, fan.share(i, at));
    areas += fan.doubled_area(i, at);
  }
  const double mean_shape = report[Metric::shape].mean;
  MeanRatioMesh mesh{};
  mesh.mean_area = std::ldexp(2 * report[Metric::area].mean, -2 * before.exponent);
  mesh.allowance = 1.5 / std::pow(mean_shape, 5);
  return growth_bound(largest_share, areas / static_cast<double>(fan.size()), mesh);
}

}  // namespace

void note_growth_bound(RunState& run, const TriangleView& before) {
  const SmoothingOptions& options = run.smoothing;
  if (options.method != Method::mean_ratio || options.aims_at_sizes() ||
      options.mean_ratio.target != TargetShape::uniform || !(run.result.before[Metric::shape].mean > 0)) {
    return;
  }
  const TriangleView now = run.view();
  const auto worst = worst_with_free_corner(now, run.found.fixed);
  if (!worst) {
    return;
  }
  for (const std::int32_t v : now.triangles[*worst]) {
    if (run.found.fixed[v] != 0) {
      continue;
    }
    const Fan fan(now, v);
    const Point2<double> at = now.points[v];
    const Point2<double> to = fan.middle();
    const double shape = shape_constant * fan.smallest_quotient(at);
    const double shape_there = shape_constant * fan.smallest_quotient(to);
    if (!(shape_there > shape)) {
      continue;
    }
    // Shares are areas times squares of lengths.
    const double bound = std::ldexp(bound_of(before, v, run.result.before), 4 * (before.exponent - now.exponent));
    for (std::size_t i = 0; i < fan.size(); ++i) {
      if (fan.share(i, to) > bound && fan.share(i, to) > fan.share(i, at)) {
        run.note(fmt::format(
            "the growth bound of mean-ratio keeps the worst element that could get better, of shape {:.3g} in cell {}: "
            "vertex {} may not go where its worst triangle would have {:.3g}, since another one would grow too large "
            "for the error of a solution; finer edges nearby help, and --method smart has no such bound",
            shape, run.mesh.cells[*worst], v, shape_there));
        return;
      }
    }
  }
}

}  // namespace trismooth
