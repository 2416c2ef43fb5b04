// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"

namespace trismooth::cuda {

/// Rings in input numbering, and what their vertices are called in packed numbering. For kernels.
struct RenumberingView {
  RingsView from;
  const std::int32_t* input_index;  ///< of each packed vertex
  const std::int32_t* new_number;   ///< packed, of each input vertex
  std::int32_t free_count;          ///< the first packed vertices
};

/// Brings what belongs to vertices from input into packed numbering. The rings and `input_index` are the caller's, on
/// the device.
class Renumbering {
 public:
  Renumbering(Context& context, const RingsView& from, const std::int32_t* input_index, std::int32_t free_count);

  const RenumberingView& view() const { return view_; }

 private:
  DeviceBuffer<std::int32_t> new_number_;
  RenumberingView view_;
};

/// The rings of the free vertices, of triangles. `from`: those that are renumbered.
DeviceRings renumbered(Context& context, const Renumbering& numbers, const DeviceRings& from);
/// The rings of the free vertices in records, of triangles.
template <class Slot>
SlottedRings<Slot> slotted(Context& context, const Renumbering& numbers);
/// The rings of the free vertices in records, where there are quadrilaterals. `opposites`: DeviceRings::opposites of
/// the rings that are renumbered.
template <class Slot>
SlottedRings<Slot> slotted_mixed(Context& context, const Renumbering& numbers, const std::int32_t* opposites);
/// The colours of the free vertices, below 256; `colours` are of all vertices in input numbering. Null: none.
DeviceBuffer<std::uint8_t> renumbered(Context& context, const Renumbering& numbers, const std::int32_t* colours);

}  // namespace trismooth::cuda
