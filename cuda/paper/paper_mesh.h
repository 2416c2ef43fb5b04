// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/paper/mesh_layouts.h"
#include "trismooth/cuda/primitives/point_array.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

/// The triangles around the free vertices and each vertex's incident elements, found from the rings.
struct DeviceElements {
  DeviceBuffer<TriangleVertices> triangles;  ///< every triangle with a free vertex once, counter-clockwise
  DeviceBuffer<std::uint32_t> elements;      ///< beside the rings' neighbours: the corner (v, n_i, n_i+1), as 3 t + i
};

/// Finds them. Complexity: linear, but for a search in the ring of a neighbour for each corner.
DeviceElements find_elements(Context& context, const RingsView& rings, std::size_t ring_entries);

/// Owns the paper's mesh structure in one layout. The pools are those of the rings and elements that it was made from.
template <class T, Layout layout>
class PaperMesh {
 public:
  /// `vertex_count`: all vertices; those from rings.size on are fixed. Runs the part of the initiating procedure that
  /// needs no coordinates.
  PaperMesh(Context& context, const RingsView& rings, std::int32_t vertex_count, const DeviceElements& elements);

  const MeshView<T, layout>& view() const { return view_; }
  /// Brings `points` into both buffers and evaluates all triangles and minima for the first time.
  void initiate(Context& context, const PointArray<T>& points);
  /// Copies the positions of a buffer to `points`.
  void read_positions(Context& context, std::int32_t buffer, const PointArray<T>& points) const;

 private:
  MeshView<T, layout> view_{};
  DeviceBuffer<std::uint8_t> memory_;
};

}  // namespace trismooth::cuda
