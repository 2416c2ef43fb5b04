// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// What threads list on the device, on the host. Calls list(elements, their number, count), which queues kernels that
/// count all and write those for which there is room, with room for as many elements as there turn out to be. Waits for
/// the device.
template <class Element, class List>
std::vector<Element> listed(Context& context, std::uint32_t at_most, const List& list) {
  constexpr std::uint32_t usual_size = 65536;
  std::uint32_t size = std::min(usual_size, at_most);
  for (;;) {
    DeviceBuffer<Element> elements(context, size);
    DeviceBuffer<std::uint32_t> count(context, 1);
    count.fill_bytes(0);
    list(elements.data(), size, count.data());
    const std::uint32_t found = download(context, count.data());
    if (found <= size) {
      std::vector<Element> near(found);
      elements.download(near);
      return near;
    }
    size = found;
  }
}

}  // namespace trismooth::cuda
