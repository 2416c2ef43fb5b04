#include "trismooth/mesh_io/bytes/ordered_blocks.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <tbb/parallel_pipeline.h>

namespace trismooth {

void OrderedBlocks::write_all(std::size_t count, const AnyEncode& encode) {
  const auto encode_to = [&encode](std::size_t block, MemoryBlock& bytes) {
    bytes.truncate(0);
    encode.call(encode.object, block, bytes);
  };
  const auto write_from = [this](const MemoryBlock& bytes) {
    writer_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  if (workers_.count() > 1 && count > 1) {
    workers_.start();
  }
  if (workers_.count() == 1 || count <= 1) {
    MemoryBlock bytes;
    for (std::size_t block = 0; block < count; ++block) {
      encode_to(block, bytes);
      write_from(bytes);
    }
    return;
  }
  // Blocks begin and end in their order: those at work are a window of as many as there are buffers.
  std::vector<MemoryBlock> buffers(std::min(count, 2 * static_cast<std::size_t>(workers_.count()) + 2));
  std::size_t next = 0;
  const auto buffer_of = [&buffers](std::size_t block) -> MemoryBlock& { return buffers[block % buffers.size()]; };
  workers_.run([&] {
    tbb::parallel_pipeline(
        buffers.size(),
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
          if (next == count) {
            control.stop();
            return next;
          }
          return next++;
        }) & tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, [&](std::size_t block) {
          encode_to(block, buffer_of(block));
          return block;
        }) & tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [&](std::size_t block) {
          write_from(buffer_of(block));
        }));
  });
}

}  // namespace trismooth
