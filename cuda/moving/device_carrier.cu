// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "trismooth/cuda/moving/device_carrier.h"
#include "trismooth/cuda/moving/device_rows.cuh"
#include "trismooth/smoothing/moving/carry.h"

namespace trismooth::cuda {

DeviceCarrier::Rows::Rows(Context& context, const WeightedRows& rows)
    : offsets(context, rows.offsets),
      unknowns(context, rows.unknowns),
      weights(context, rows.weights),
      view{offsets.data(), unknowns.data(), weights.data(), rows.size()} {}

DeviceCarrier::Level::Level(Context& context, const GraphLaplacian::Level& level)
    : offsets(context, level.graph.offsets),
      linked(context, level.graph.linked),
      weights(context, level.graph.weights),
      diagonal(context, level.graph.diagonal),
      spread(context, level.spread),
      gather(context, level.gather),
      view{{offsets.data(), linked.data(), weights.data(), diagonal.data(), level.graph.size()},
           spread.view,
           gather.view} {}

DeviceCarrier::DeviceCarrier(Context& context, const Carrier& carrier)
    : context_(&context),
      carried_(context, carrier.carried()),
      held_(context, carrier.held()),
      held_offsets_(context, carrier.held_offsets()),
      held_links_(context, carrier.held_links()),
      held_weight_(carrier.held_weight()) {
  for (const GraphLaplacian::Level& level : carrier.laplacian().levels()) {
    views_.push_back(levels_.emplace_back(context, level).view);
  }
  context.synchronize();
}

void DeviceCarrier::carry(const HeldMotion& motion, const Point2<double>* from, Point2<double>* now) {
  const DeviceBuffer<Point2<double>> turns(*context_, motion.turns);
  DeviceRows rows(*context_);
  trismooth::carry({views_, carried_.data(), held_.data(), held_offsets_.data(), held_links_.data(), held_weight_},
                   motion.all, turns.data(), from, now, rows);
}

}  // namespace trismooth::cuda
