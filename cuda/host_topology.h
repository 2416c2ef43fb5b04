// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/device_constraints.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/host_copy.h"
#include "trismooth/cuda/topology/mesh_topology.h"
#include "trismooth/cuda/topology/mixed_list.h"
#include "trismooth/smoothing/rings/mesh_connectivity.h"

namespace trismooth::cuda {

/// How triangles and quadrilaterals in device memory hang together, found on the host from copies of the elements and
/// constraints: by what finds it for the CPU. The device orients them, and counts.
///
/// Device memory while it lives, for n vertices and m elements: n + 4 m bytes, 5 m more once oriented.
class HostTopology final : public ListTopology<MixedList> {
 public:
  /// `elements`: in device memory, which the caller owns and keeps as long as this object; `on_host`: a copy of them.
  /// `constraints` are not looked at later. `threads` as in SmoothingOptions. Throws as connect_triangles() and
  /// fixed_vertices() do, and DeviceError. Complexity: linear.
  HostTopology(Context& context, std::int32_t vertex_count, const std::int32_t* elements,
               std::vector<MixedElement> on_host, const DeviceConstraints& constraints, int threads);

  NearLines near_lines(const std::int32_t* regions) override;
  LayersResult hold_layers(const Point2<double>* local_points, Layers layers, bool slides,
                           std::vector<std::int32_t>& held) override;
  DeviceRings rings() override;
  OwnElements elements() const override { return on_host_; }
  std::int64_t quadrilaterals() const override { return quadrilaterals_; }
  std::string_view note() const override;

 private:
  std::vector<std::uint8_t> downloaded_reversed() const;

  HostCopier copier_;
  std::vector<MixedElement> on_host_;
  std::int64_t quadrilaterals_;
  MeshConnectivity connectivity_;
  std::vector<std::uint8_t> fixed_on_host_;
};

}  // namespace trismooth::cuda
