// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/heights.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/quality/corner_points.h"
#include "trismooth/quality/metric_lanes.h"
#include "trismooth/quality/orientation.h"

namespace trismooth {

namespace {

void require_places(const ElementValues& values, std::size_t triangles) {
  for (std::size_t m = 0; m < values.size(); ++m) {
    if (!values[m].empty() && values[m].size() != triangles) {
      throw std::invalid_argument(std::string("the values of ") + std::string(info(static_cast<Metric>(m)).name) +
                                  ": " + std::to_string(values[m].size()) + " places for " + std::to_string(triangles) +
                                  " triangles");
    }
  }
}

void find_values(const TriangleView& view, const ElementValues& values, Workers& workers) {
  if (std::ranges::all_of(values, [](const auto& of_metric) { return of_metric.empty(); })) {
    return;
  }
  constexpr std::int64_t grain = 4096;
  workers.for_blocks(std::ssize(view.triangles), grain, [&](std::int64_t begin, std::int64_t end) {
    std::vector<MetricValues> found;
    const auto keep = [&](std::size_t first, std::span<const CornerPoints> corners) {
      found.resize(corners.size());
      evaluate_all(corners, found);
      for (std::size_t m = 0; m < values.size(); ++m) {
        if (values[m].empty()) {
          continue;
        }
        const int exponent = static_cast<Metric>(m) == Metric::area ? 2 * view.exponent : 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          values[m][first + i] = std::ldexp(found[i][m], exponent);
        }
      }
    };
    for_corners(view, static_cast<std::size_t>(begin), static_cast<std::size_t>(end), keep);
  });
}

/// The quality of triangles that have been connected.
QualityReport report_of(std::span<const Triangle> triangles, const TriangleTopology& topology,
                        const ConstPointView& points, const ElementValues& values, const QualityOptions& options,
                        Workers& workers) {
  const std::vector<Point2<double>> stored = points.read(workers);
  if (points.components() == 3) {
    require_one_height(points, stored, [&] { return topology.hold; });
  }
  const LocalPoints local = entered(local_frame_of_cells(stored, topology.hold), stored);
  const Orientation orientation = orient(topology, triangles, local.points, workers);
  const TriangleView view{local.points, triangles, orientation.reversed, local.frame.exponent};
  find_values(view, values, workers);
  QualityReport report = quality_report(view, options);
  for (WorstElement& element : report.worst) {
    element.centroid = local.frame.leave(element.centroid);
  }
  return report;
}

}  // namespace

QualityReport quality(const ConstPointView& points, const IndexView& triangles, const QualityOptions& options) {
  return quality(points, triangles, ElementValues{}, options);
}

QualityReport quality(const ConstPointView& points, const IndexView& triangles, const ElementValues& values,
                      const QualityOptions& options) {
  require_places(values, triangles.size());
  Workers workers(options.threads);
  check_mesh_size(static_cast<std::int64_t>(points.size()), static_cast<std::int64_t>(triangles.size()));
  const auto vertex_count = static_cast<std::int32_t>(points.size());
  std::vector<Triangle> converted;
  const std::span<const Triangle> listed = triangles.triangles(vertex_count, converted);
  return report_of(listed, connect_triangles(vertex_count, listed, workers), points, values, options, workers);
}

class MeshQuality::Implementation {
 public:
  Implementation(std::int64_t vertex_count, const IndexView& triangles, int threads) {
    Workers workers(threads);
    check_mesh_size(vertex_count, static_cast<std::int64_t>(triangles.size()));
    vertex_count_ = static_cast<std::int32_t>(vertex_count);
    const std::span<const Triangle> listed = triangles.triangles(vertex_count, triangles_);
    if (listed.data() != triangles_.data()) {
      triangles_.assign(listed.begin(), listed.end());
    }
    topology_ = connect_triangles(vertex_count_, triangles_, workers);
  }

  QualityReport report(const ConstPointView& points, const QualityOptions& options) const {
    require_a_point_a_vertex(points.size(), points.components(), vertex_count_);
    Workers workers(options.threads);
    return report_of(triangles_, topology_, points, {}, options, workers);
  }

 private:
  std::int32_t vertex_count_ = 0;
  std::vector<Triangle> triangles_;
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
