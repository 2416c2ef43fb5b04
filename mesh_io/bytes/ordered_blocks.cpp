// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/ordered_blocks.h"

#include <algorithm>

namespace trismooth {

void OrderedBlocks::write_all(std::size_t count, const AnyEncode& encode) {
  // Some in work, some that wait for their turn.
  const std::size_t places = std::min(count, 2 * static_cast<std::size_t>(workers_.workers.count()) + 2);
  if (buffers_.size() < places) {
    buffers_.resize(places);
  }
  workers_.workers.for_blocks_in_order(
      count, places,
      [&](std::size_t block, std::size_t place) {
        MemoryBlock& bytes = buffers_[place].bytes;
        bytes.truncate(0);
        encode.call(encode.object, block, bytes);
      },
      [&](std::size_t /*block*/, std::size_t place) {
        const MemoryBlock& bytes = buffers_[place].bytes;
        sink_({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      });
}

}  // namespace trismooth
