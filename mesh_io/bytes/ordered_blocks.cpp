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
        buffers_[place].truncate(0);
        encode.call(encode.object, block, buffers_[place]);
      },
      [&](std::size_t /*block*/, std::size_t place) {
        sink_({reinterpret_cast<const char*>(buffers_[place].data()), buffers_[place].size()});
      });
}

}  // namespace trismooth
