// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/components.h"
#include "trismooth/cuda/topology/element_quotients.h"
#include "trismooth/cuda/topology/orientation.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// How the elements of a mesh in device memory hang together, whoever has found it. The same in every number as what
/// find_mesh_rings() finds. Coordinates are on the device.
class MeshTopology {
 public:
  MeshTopology() = default;
  MeshTopology(const MeshTopology&) = delete;
  MeshTopology& operator=(const MeshTopology&) = delete;
  virtual ~MeshTopology() = default;

  /// What trismooth::find_slidable() is to look at. `regions`: those of the constraints, on the device. Waits.
  virtual NearLines near_lines(const std::int32_t* regions) = 0;

  /// trismooth::hold_layers() at these coordinates, in the orientation found last. `held`: the vertices that it marks.
  virtual LayersResult hold_layers(const Point2<double>* local_points, Layers layers, bool slides,
                                   std::vector<std::int32_t>& held) = 0;

  /// Orients the components by these coordinates, which are in the local frame. Returns whether the orientation is
  /// another than that of the last call, or this is the first.
  virtual bool orient(const Point2<double>* local_points) = 0;

  /// The one-rings of the free vertices in the orientation found last.
  virtual DeviceRings rings() = 0;

  /// trismooth::FixedElements::smallest_quotient() in the orientation found last.
  virtual double smallest_fixed_quotient(const Point2<double>* local_points) const = 0;

  /// What is inverted or has no area of the points as they are stored, in the orientation found last. `frame`: on the
  /// device. Waits.
  virtual InvalidCounts invalid_elements(const Point2<double>* stored, const LocalFrame* frame) const = 0;

  /// A copy of the elements on the host. Waits.
  virtual OwnElements elements() const = 0;
  virtual std::size_t element_count() const = 0;
  virtual std::int64_t quadrilaterals() const { return 0; }

  /// What the user is to know of who has found it, or empty.
  virtual std::string_view note() const { return {}; }

  /// One byte a vertex, on the device: why it is fixed, bits of namespace hold; 0 is free.
  virtual const std::uint8_t* fixed() const = 0;
  /// One byte an element, on the device: 1 where it is listed clockwise in the orientation found last. Null before the
  /// first.
  virtual const std::uint8_t* reversed() const = 0;
};

/// What the device does for every list of elements, a TriangleList or a MixedList, once it is known how they hang
/// together.
template <class List>
class ListTopology : public MeshTopology {
 public:
  bool orient(const Point2<double>* local_points) final {
    return cuda::orient(*context_, list_, local_points, components_, orientation_);
  }
  double smallest_fixed_quotient(const Point2<double>* local_points) const final {
    return cuda::smallest_fixed_quotient(*context_, list_, local_points, reversed(), fixed());
  }
  InvalidCounts invalid_elements(const Point2<double>* stored, const LocalFrame* frame) const final {
    return cuda::invalid_elements(*context_, list_, stored, frame, reversed());
  }
  std::size_t element_count() const final { return static_cast<std::size_t>(list_.count); }
  const std::uint8_t* fixed() const final { return fixed_.data(); }
  const std::uint8_t* reversed() const final { return orientation_.reversed.data(); }

 protected:
  ListTopology(Context& context, const List& list) : context_(&context), list_(list) {}

  Context* context_;
  List list_;
  DeviceBuffer<std::uint8_t> fixed_;
  Components components_;

 private:
  DeviceOrientation orientation_;
};

}  // namespace trismooth::cuda
