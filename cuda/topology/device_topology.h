// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/topology/constraints.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/large_fans.h"
#include "trismooth/cuda/topology/mesh_topology.h"
#include "trismooth/cuda/topology/neighbour_search.h"
#include "trismooth/cuda/topology/triangle_list.h"

namespace trismooth::cuda {

/// How triangles in device memory hang together, found on the device: the paper's finding of neighbours and determining
/// of constraints.
///
/// Memory while it lives, for n vertices and m triangles: 5 n + 16 m bytes, 17 m once oriented; 4 m more for a while in
/// the constructor. Vertices of more than VertexFan::capacity triangles take more: see find_large_fans().
class DeviceTopology final : public ListTopology<TriangleList> {
 public:
  /// Analyses 3 `triangle_count` vertex numbers in device memory, which the caller owns and keeps as long as this
  /// object; `constraints` are not looked at later. All work is queued on the context's stream, which is waited for.
  /// Throws MeshError and std::invalid_argument, with the same messages, as connect_triangles() and
  /// check_constraints() do (lengths of arrays apart), and DeviceError.
  DeviceTopology(Context& context, std::int32_t vertex_count, std::int32_t triangle_count,
                 const std::int32_t* triangles, const DeviceConstraints& constraints, NeighbourSearch way);

  NearLines near_lines(const std::int32_t* regions) override;
  LayersResult hold_layers(const Point2<double>* local_points, Layers layers, bool slides,
                           std::vector<std::int32_t>& held) override;
  DeviceRings rings() override;
  OwnElements elements() const override;

  std::int32_t components() const { return components_.count; }
  std::int64_t reoriented_triangles() const { return components_.reoriented_triangles; }

 private:
  std::int32_t vertex_count() const { return corners_.view().vertex_count; }

  IncidentCorners corners_;
  LargeFans large_fans_;
};

}  // namespace trismooth::cuda
