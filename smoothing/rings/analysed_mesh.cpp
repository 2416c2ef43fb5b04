// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/rings/analysed_mesh.h"

#include <utility>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/orientation.h"
#include "trismooth/smoothing/layers/layers.h"

namespace trismooth {

AnalysedMesh::AnalysedMesh(std::int32_t vertex_count, const ElementList& elements, const Constraints& constraints,
                           Workers& workers) {
  elements.visit([&](const auto& listed) {
    connectivity_ = MeshConnectivity(vertex_count, listed, workers);
    mesh_.fixed = connectivity_.fixed_vertices(listed, constraints, workers);
  });
  mesh_.components = connectivity_.components().components;
  if (constraints.slide.along != Slide::off) {
    slide_ = KeptConstraints({.regions = constraints.regions, .slide = constraints.slide});
  }
}

bool AnalysedMesh::look_at(std::span<const Point2<double>> local, const ElementList& elements, Layers layers,
                           Workers& workers) {
  const bool is_first = !has_found_layers_;
  Orientation orientation = elements.visit([&](const auto& listed) {
    Orientation found = orient(connectivity_.components(), listed, local, workers);
    // Each of these once, also where what comes next is given up.
    if (is_first) {
      mesh_.layers = hold_layers(local, listed, found.reversed, layers, slide_.has_value(), mesh_.fixed, workers);
      has_found_layers_ = true;
    }
    if (slide_) {
      mesh_.slidable = find_slidable(listed, mesh_.fixed, slide_->view(), workers);
      slide_.reset();
    }
    return found;
  });
  mesh_.reoriented_triangles = orientation.reoriented_triangles;
  if (!is_first && orientation.reversed == mesh_.reversed) {
    return false;
  }
  mesh_.reversed = std::move(orientation.reversed);
  return true;
}

}  // namespace trismooth
