// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/halfedge/mesh_quality.h"

#include <variant>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/halfedge/flat_mesh.h"
#include "trismooth/mesh_io/halfedge/mesh_place.h"
#include "trismooth/quality/quality.h"

namespace trismooth {

namespace {

template <class T>
QualityReport report_of(const NumberRows<const T>& points, const FlatMesh& mesh, const QualityOptions& options) {
  const bool are_all_finite = require_finite(points, mesh.in_a_cell);
  const IndexView elements(mesh.elements.list());
  if (const auto axes = exact_axes(points, mesh.in_a_cell)) {
    const NumberRows<const T> pairs = along(points, *axes);
    if (are_all_finite) {
      return quality(ConstPointView(pairs), elements, options);
    }
    const std::vector<Point2<double>> copy = pairs_of(pairs, mesh.in_a_cell);
    return quality(copy, elements, options);
  }
  Workers workers(options.threads);
  const std::vector<double> xyz = triples_of(points);
  const InPlane placed(fit_plane(xyz, mesh.in_a_cell, cells_of(mesh), storage_of<T>, workers), xyz, mesh.in_a_cell,
                       workers);
  return quality(placed.points, elements, options);
}

}  // namespace

QualityReport open_mesh_quality(const ConstOpenMeshView& mesh, const QualityOptions& options) {
  const FlatMesh flat = flat_mesh(*mesh.mesh);
  QualityReport report = std::visit([&](const auto& points) { return report_of(points, flat, options); }, mesh.points);
  for (WorstElement& element : report.worst) {
    element.element = flat.faces[static_cast<std::size_t>(element.element)];
  }
  return report;
}

}  // namespace trismooth
