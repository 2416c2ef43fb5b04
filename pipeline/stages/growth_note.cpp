// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/growth_note.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/quality/element.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/rings/ring_elements.h"

namespace trismooth {

namespace {

/// The elements around one vertex, which may be taken to lie elsewhere: as the method has them in its ring.
class Fan {
 public:
  Fan(const MeshView& mesh, std::int32_t vertex) : points_(mesh.points) {
    mesh.visit([&](const auto& view) {
      for (std::size_t e = 0; e < view.elements.size(); ++e) {
        if (std::ranges::find(view.elements[e], vertex) != view.elements[e].end()) {
          add(corners_of(canonical_corners(view, e)), vertex);
        }
      }
    });
  }

  std::size_t size() const { return corners_.size(); }

  /// The mean of the neighbours, each of which is of two of the elements.
  Point2<double> middle() const {
    Point2<double> sum{0, 0};
    for (const auto& corner : corners_) {
      const auto [next, previous] = std::visit([](const auto& of) { return std::pair(of.next, of.previous); }, corner);
      for (const std::int32_t v : {next, previous}) {
        sum = {sum.x + points_[v].x, sum.y + points_[v].y};
      }
    }
    const double weight = 1 / (2 * static_cast<double>(size()));
    return {weight * sum.x, weight * sum.y};
  }

  double smallest_quotient(Point2<double> at) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size(); ++i) {
      smallest = std::min(smallest, with_spokes(i, at, [](const auto& corner) { return shape_quotient(corner); }));
    }
    return smallest;
  }

  /// Twice the area of one of them, and its share of the error.
  double area(std::size_t i, Point2<double> at) const { return size(i, at).doubled_area; }
  double share(std::size_t i, Point2<double> at) const { return share_of_error(size(i, at)); }

 private:
  void add(std::span<const std::int32_t> corners, std::int32_t vertex) {
    const auto i = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
    const std::int32_t next = next_corner(corners, i);
    const std::int32_t previous = previous_corner(corners, i);
    if (corners.size() == 3) {
      corners_.emplace_back(TriangleCorner<std::int32_t>{next, previous});
    } else {
      corners_.emplace_back(QuadrilateralCorner<std::int32_t>{next, corners[(i + 2) % 4], previous});
    }
  }

  template <class Body>
  std::invoke_result_t<Body, TriangleCorner<RingSpoke<double>>> with_spokes(std::size_t i, Point2<double> at,
                                                                            const Body& body) const {
    return std::visit(
        [&](const auto& corner) { return body(corner.with([&](std::int32_t v) { return spoke_to(points_[v], at); })); },
        corners_[i]);
  }
  ElementSize<double> size(std::size_t i, Point2<double> at) const {
    ElementSize<double> size = with_spokes(i, at, [](const auto& corner) { return size_of(corner); });
    size.doubled_area = std::abs(size.doubled_area);
    return size;
  }

  std::span<const Point2<double>> points_;
  std::vector<std::variant<TriangleCorner<std::int32_t>, QuadrilateralCorner<std::int32_t>>> corners_;
};

/// Twice the mean area of the elements, where quadrilaterals count by half: as size_of() has them. In the file's unit.
double mean_doubled_area(const QualityReport& report) {
  if (report.kinds.empty()) {
    return 2 * report[Metric::area].mean;
  }
  double sum = 0;
  for (const KindQuality& kind : report.kinds) {
    const double weight = kind.kind == ElementKind::triangle ? 2 : 1;
    sum += weight * kind[Metric::area].mean * static_cast<double>(kind.elements);
  }
  return sum / static_cast<double>(report.elements());
}

/// The bound of the vertex, in the local unit of `before`.
double bound_of(const MeshView& before, std::int32_t vertex, const QualityReport& report) {
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
  mesh.mean_area = std::ldexp(mean_doubled_area(report), -2 * before.exponent);
  mesh.allowance = 1.5 / std::pow(mean_shape, 5);
  return growth_bound(largest_share, areas / static_cast<double>(fan.size()), mesh);
}

}  // namespace

bool may_have_growth_note(const SmoothingOptions& options, const QualityReport& before) {
  return options.method == Method::mean_ratio && !options.aims_at_sizes() &&
         options.mean_ratio.target == TargetShape::uniform && before[Metric::shape].mean > 0;
}

WorstFreeElement worst_with_free_corner(const MeshView& mesh, std::span<const std::uint8_t> fixed,
                                        const std::function<bool(std::size_t)>& counts) {
  WorstFreeElement worst;
  mesh.visit([&](const auto& view) {
    for (std::size_t e = 0; e < view.elements.size(); ++e) {
      const double quotient = quotient_at(canonical_corners(view, e), view.points);
      if (quotient < worst.quotient && counts(e) && !all_are_fixed(view.elements[e], fixed)) {
        worst = {quotient, static_cast<std::int64_t>(e)};
      }
    }
  });
  return worst;
}

std::string growth_note(const MeshView& before, const MeshView& now, std::int32_t vertex, const QualityReport& report,
                        double quotient, std::int64_t cell, std::int64_t number) {
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
          "vertex {} may not go where its worst element would have {:.3g}, since another one would grow too large "
          "for the error of a solution; finer edges nearby help, and --method smart has no such bound",
          shape_constant * quotient, cell, number, shape_there);
    }
  }
  return {};
}

void note_growth_bound(RunState& run, const MeshView& before) {
  if (!may_have_growth_note(run.smoothing, run.result.before)) {
    return;
  }
  const MeshView now = run.view();
  const WorstFreeElement worst = worst_with_free_corner(now, run.found.fixed, [](std::size_t) { return true; });
  if (worst.element < 0) {
    return;
  }
  for (const std::int32_t v : now.elements[static_cast<std::size_t>(worst.element)]) {
    if (run.found.fixed[v] == 0) {
      if (std::string said =
              growth_note(before, now, v, run.result.before, worst.quotient, run.mesh.cells[worst.element], v);
          !said.empty()) {
        run.note(std::move(said));
        return;
      }
    }
  }
}

}  // namespace trismooth
