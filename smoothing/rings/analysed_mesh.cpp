// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/analysed_mesh.h"

#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth {

template <class Corners>
void AnalysedMesh::connect(std::int32_t vertex_count, std::span<const Corners> elements, const Constraints& constraints,
                           Workers& workers) {
  connectivity_ = MeshConnectivity(vertex_count, elements, workers);
  mesh_.fixed = connectivity_.fixed_vertices(elements, constraints, workers);
  mesh_.components = connectivity_.components().components;
  if (constraints.slide.along != Slide::off) {
    slide_ = KeptConstraints({.regions = constraints.regions, .slide = constraints.slide});
  }
}

AnalysedMesh::AnalysedMesh(std::int32_t vertex_count, std::span<const Triangle> triangles,
                           const Constraints& constraints, Workers& workers) {
  connect(vertex_count, triangles, constraints, workers);
}

AnalysedMesh::AnalysedMesh(std::int32_t vertex_count, std::span<const MixedElement> elements,
                           const Constraints& constraints, Workers& workers) {
  connect(vertex_count, elements, constraints, workers);
}

template <class Corners>
bool AnalysedMesh::look(std::span<const Point2<double>> local, std::span<const Corners> elements, Layers layers,
                        Workers& workers) {
  Orientation orientation = orient(connectivity_.components(), elements, local, workers);
  const bool is_first = !has_found_layers_;
  // Each of these once, also where what comes next is given up.
  if (is_first) {
    mesh_.layers = hold_layers(local, elements, orientation.reversed, layers, slide_.has_value(), mesh_.fixed, workers);
    has_found_layers_ = true;
  }
  if (slide_) {
    mesh_.slidable = find_slidable(elements, mesh_.fixed, slide_->view(), workers);
    slide_.reset();
  }
  mesh_.reoriented_triangles = orientation.reoriented_triangles;
  if (!is_first && orientation.reversed == mesh_.reversed) {
    return false;
  }
  mesh_.reversed = std::move(orientation.reversed);
  return true;
}

bool AnalysedMesh::look_at(std::span<const Point2<double>> local, std::span<const Triangle> triangles, Layers layers,
                           Workers& workers) {
  return look(local, triangles, layers, workers);
}
bool AnalysedMesh::look_at(std::span<const Point2<double>> local, std::span<const MixedElement> elements, Layers layers,
                           Workers& workers) {
  return look(local, elements, layers, workers);
}

}  // namespace trismooth
