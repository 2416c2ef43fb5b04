// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/smoothing/slide/slide_chains.h"
#include "trismooth/smoothing/slide/slide_update.h"

namespace trismooth::cuda {

/// SlideElements in device memory, corners in packed numbers.
struct DeviceSlideElements {
  DeviceBuffer<std::int32_t> begins;
  DeviceBuffer<FanSide> sides;
  DeviceBuffer<MixedElement> held;

  DeviceSlideElements(Context& context, const SlideElements& packed);
};

/// Chains in device memory, with what a run writes: the places of the knots. One copy brings all of it over.
class DeviceChains {
 public:
  /// None.
  DeviceChains() = default;
  /// `numbers`: packed, of the vertices that the chains name; as SlideChains::renumber(). `elements` outlive it.
  DeviceChains(Context& context, const SlideChains& chains, std::span<const std::int32_t> numbers,
               DeviceSlideElements& elements);

  const SlideView& view() const { return view_; }
  SlidePlaces places() const { return places_; }
  /// Waits for the places.
  void download_places(std::span<SlidePlace> places) const;
  /// Puts all vertices at their own knots, as they were when the chains came.
  void begin(const SlideChains& chains);

 private:
  Context* context_ = nullptr;
  DeviceBuffer<std::byte> memory_;
  SlideView view_{};
  SlidePlaces places_{};
};

}  // namespace trismooth::cuda
