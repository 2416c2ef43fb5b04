// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/heights.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/elements_by_kind.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/orientation.h"

namespace trismooth {

namespace {

void require_places(const ElementValues& values, std::size_t elements) {
  for (const ElementKind kind : {ElementKind::triangle, ElementKind::quadrilateral}) {
    for (const MetricInfo& metric : all_metrics(kind)) {
      const std::span<double> of_metric = values[static_cast<std::size_t>(metric.metric)];
      if (!of_metric.empty() && of_metric.size() != elements) {
        throw std::invalid_argument("the values of " + std::string(metric.name) + ": " +
                                    std::to_string(of_metric.size()) + " places for " + std::to_string(elements) +
                                    " elements");
      }
    }
  }
}

bool is_wanted(const ElementValues& values) {
  return !std::ranges::all_of(values, [](const auto& of_metric) { return of_metric.empty(); });
}

/// Writes the values that are asked for of the view's elements. number(i): where that of its element i goes.
template <class Corners, class NumberOf>
void find_values(const ElementView<Corners>& view, const ElementValues& values, const NumberOf& number,
                 Workers& workers) {
  using Points = decltype(corner_points(view, 0));
  constexpr std::int64_t grain = 4096;
  workers.for_blocks(std::ssize(view.elements), grain, [&](std::int64_t begin, std::int64_t end) {
    std::vector<KindValues<Points>> found;
    const auto keep = [&](std::size_t first, std::span<const Points> corners) {
      found.resize(corners.size());
      evaluate_all(corners, found);
      for (std::size_t m = 0; m < count_of_metrics<Points>; ++m) {
        const Metric metric = KindMetrics<Points>::list[m];
        const std::span<double> of_metric = values[static_cast<std::size_t>(metric)];
        if (of_metric.empty()) {
          continue;
        }
        const int exponent = metric == Metric::area ? 2 * view.exponent : 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          of_metric[number(first + i)] = std::ldexp(found[i][m], exponent);
        }
      }
    };
    for_corners(view, static_cast<std::size_t>(begin), static_cast<std::size_t>(end), keep);
  });
}

/// Those of metrics that not all elements have: whoever has them writes over it.
void fill_with_none(const ElementValues& values) {
  for (const Metric metric : {Metric::radius_ratio, Metric::skew, Metric::taper}) {
    std::ranges::fill(values[static_cast<std::size_t>(metric)], std::numeric_limits<double>::quiet_NaN());
  }
}

/// The points of elements that have been connected, in their local frame.
template <class Topology>
LocalPoints local_points(const ConstPointView& points, const Topology& topology, Workers& workers) {
  const std::vector<Point2<double>> stored = points.read(workers);
  if (points.components() == 3) {
    require_one_height(points, stored, [&] { return topology.hold; });
  }
  return entered(local_frame_of_cells(stored, topology.hold), stored);
}

QualityReport in_units_of_caller(QualityReport report, const LocalFrame& frame) {
  for (WorstElement& element : report.worst) {
    element.centroid = frame.leave(element.centroid);
  }
  return report;
}

/// The quality of elements that have been connected.
template <class Corners>
QualityReport report_of(std::span<const Corners> elements, const TriangleTopology& topology,
                        const ConstPointView& points, const ElementValues& values, const QualityOptions& options,
                        Workers& workers) {
  const LocalPoints local = local_points(points, topology, workers);
  const Orientation orientation = orient(topology, elements, local.points, workers);
  const MeshView view{local.points, elements, orientation.reversed, local.frame.exponent};
  if (is_wanted(values)) {
    fill_with_none(values);
    for_each_kind(view, [&](const auto& kind, const auto& number) { find_values(kind, values, number, workers); });
  }
  return in_units_of_caller(quality_report(view, options), local.frame);
}

void require_mesh_size(std::int64_t vertex_count, const IndexView& indices) {
  check_mesh_size(vertex_count, static_cast<std::int64_t>(indices.size()), indices.may_have_quadrilaterals() ? 4 : 3);
}

}  // namespace

QualityReport quality(const ConstPointView& points, const IndexView& triangles, const QualityOptions& options) {
  return quality(points, triangles, ElementValues{}, options);
}

QualityReport quality(const ConstPointView& points, const IndexView& triangles, const ElementValues& values,
                      const QualityOptions& options) {
  require_places(values, triangles.size());
  Workers workers(options.threads);
  const auto vertex_count = static_cast<std::int64_t>(points.size());
  require_mesh_size(vertex_count, triangles);
  OwnElements converted;
  return triangles.list(vertex_count, converted).visit([&](const auto& listed) {
    return report_of(listed, connect_triangles(static_cast<std::int32_t>(vertex_count), listed, workers), points,
                     values, options, workers);
  });
}

class MeshQuality::Implementation {
 public:
  Implementation(std::int64_t vertex_count, const IndexView& triangles, int threads) {
    Workers workers(threads);
    require_mesh_size(vertex_count, triangles);
    vertex_count_ = static_cast<std::int32_t>(vertex_count);
    elements_ = own_elements(triangles, vertex_count);
    topology_ =
        elements_.list().visit([&](const auto& listed) { return connect_triangles(vertex_count_, listed, workers); });
  }

  QualityReport report(const ConstPointView& points, const QualityOptions& options) const {
    require_a_point_a_vertex(points.size(), points.components(), vertex_count_);
    Workers workers(options.threads);
    return elements_.list().visit(
        [&](const auto& elements) { return report_of(elements, topology_, points, {}, options, workers); });
  }

 private:
  std::int32_t vertex_count_ = 0;
  OwnElements elements_;
  TriangleTopology topology_;
};

MeshQuality::MeshQuality(std::int64_t vertex_count, const IndexView& triangles, int threads)
    : implementation_(std::make_unique<Implementation>(vertex_count, triangles, threads)) {}

MeshQuality::MeshQuality(MeshQuality&&) noexcept = default;
MeshQuality& MeshQuality::operator=(MeshQuality&&) noexcept = default;
MeshQuality::~MeshQuality() = default;

QualityReport MeshQuality::report(const ConstPointView& points, const QualityOptions& options) const {
  return implementation_->report(points, options);
}

}  // namespace trismooth
