// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/components.h"
#include "trismooth/cuda/topology/constraints.h"
#include "trismooth/cuda/topology/incident_corners.h"
#include "trismooth/cuda/topology/large_fans.h"
#include "trismooth/cuda/topology/neighbour_search.h"
#include "trismooth/cuda/topology/orientation.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/cuda/topology/triangle_quotients.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// How triangles in device memory hang together, found on the device: the paper's finding of neighbours and determining
/// of constraints. The same in every number as what find_mesh_rings() finds on the host.
///
/// Memory while it lives, for n vertices and m triangles: 5 n + 16 m bytes, 17 m once oriented; 4 m more for a while in
/// the constructor. Vertices of more than VertexFan::capacity triangles take more: see find_large_fans().
class DeviceTopology {
 public:
  /// Analyses 3 `triangle_count` vertex numbers in device memory, which the caller owns and keeps as long as this
  /// object; `constraints` are not looked at later. All work is queued on the context's stream, which is waited for.
  /// Throws MeshError and std::invalid_argument, with the same messages, as connect_triangles() and
  /// check_constraints() do (lengths of arrays apart), and DeviceError.
  DeviceTopology(Context& context, std::int32_t vertex_count, std::int32_t triangle_count,
                 const std::int32_t* triangles, const DeviceConstraints& constraints, NeighbourSearch way);

  /// What trismooth::find_slidable() is to look at. `regions`: those of the constraints, on the device. Waits.
  NearLines near_lines(const std::int32_t* regions) const;

  /// trismooth::hold_layers() at these coordinates, which are on the device, in the orientation found last. `held`: the
  /// vertices that it marks.
  LayersResult hold_layers(const Point2<double>* points, Layers layers, bool slides, std::vector<std::int32_t>& held);

  /// Orients the components by these coordinates, which are on the device and in the local frame. Returns whether the
  /// orientation is another than that of the last call, or this is the first.
  bool orient(const Point2<double>* local_points);

  /// The one-rings of the free vertices in the orientation found last.
  DeviceRings rings() const;

  /// trismooth::FixedElements::smallest_quotient() in the orientation found last.
  double smallest_fixed_quotient(const Point2<double>* local_points) const;

  /// What is inverted or has no area of the points as they are stored, in the orientation found last. `frame`: on the
  /// device. Waits.
  InvalidCounts invalid_triangles(const Point2<double>* stored, const LocalFrame* frame) const;

  std::int32_t vertex_count() const { return corners_.view().vertex_count; }
  /// One byte a vertex: why it is fixed, bits of namespace hold; 0 is free.
  const std::uint8_t* fixed() const { return fixed_.data(); }
  /// One byte a triangle: 1 where it is listed clockwise in the orientation found last. Null before the first.
  const std::uint8_t* reversed() const { return orientation_.reversed.data(); }
  std::int32_t components() const { return components_.count; }
  std::int64_t reoriented_triangles() const { return components_.reoriented_triangles; }

 private:
  Context* context_;
  TriangleList triangles_;
  IncidentCorners corners_;
  DeviceBuffer<std::uint8_t> fixed_;
  LargeFans large_fans_;
  Components components_;
  DeviceOrientation orientation_;
};

}  // namespace trismooth::cuda
