// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/moving/carrier.h"

namespace trismooth::cuda {

/// A Carrier in device memory.
class DeviceCarrier {
 public:
  /// Copies what it needs.
  DeviceCarrier(Context& context, const Carrier& carrier);

  /// trismooth::carry(), of arrays on the device. Waits for it now and then.
  void carry(const HeldMotion& motion, const Point2<double>* from, Point2<double>* now);

  /// Those that are carried, and Carrier::held(), on the device.
  const DeviceBuffer<std::int32_t>& carried() const { return carried_; }
  const DeviceBuffer<std::int32_t>& held() const { return held_; }

 private:
  struct Rows {
    Rows(Context& context, const WeightedRows& rows);

    DeviceBuffer<std::int64_t> offsets;
    DeviceBuffer<std::int32_t> unknowns;
    DeviceBuffer<double> weights;
    RowsView view;
  };
  struct Level {
    Level(Context& context, const GraphLaplacian::Level& level);

    DeviceBuffer<std::int64_t> offsets;
    DeviceBuffer<std::int32_t> linked;
    DeviceBuffer<double> weights;
    DeviceBuffer<double> diagonal;
    Rows spread;
    Rows gather;
    LevelView view;
  };

  Context* context_;
  DeviceBuffer<std::int32_t> carried_;
  DeviceBuffer<std::int32_t> held_;
  DeviceBuffer<std::int64_t> held_offsets_;
  DeviceBuffer<HeldLink> held_links_;
  double held_weight_;
  std::vector<Level> levels_;
  std::vector<LevelView> views_;  ///< of these
};

}  // namespace trismooth::cuda
