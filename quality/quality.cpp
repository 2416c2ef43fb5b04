#include "trismooth/quality/quality.h"

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/heights.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/base/workers.h"
#include "trismooth/quality/orientation.h"

namespace trismooth {

QualityReport quality(const ConstPointView& points, const IndexView& triangles, const QualityOptions& options) {
  Workers workers(options.threads);
  check_mesh_size(static_cast<std::int64_t>(points.size()), static_cast<std::int64_t>(triangles.size()));
  const auto vertex_count = static_cast<std::int32_t>(points.size());
  std::vector<Triangle> converted;
  const std::span<const Triangle> listed = triangles.triangles(vertex_count, converted);
  const TriangleTopology topology = connect_triangles(vertex_count, listed, workers);
  const std::vector<Point2<double>> stored = points.read(workers);
  if (points.components() == 3) {
    require_one_height(points, stored, [&] { return topology.hold; });
  }
  const LocalPoints local = entered(local_frame_of_cells(stored, topology.hold), stored);
  const Orientation orientation = orient(topology, listed, local.points, workers);
  QualityReport report = quality_report({local.points, listed, orientation.reversed, local.frame.exponent}, options);
  for (WorstElement& element : report.worst) {
    element.centroid = local.frame.leave(element.centroid);
  }
  return report;
}

}  // namespace trismooth
