#pragma once

#include <cstddef>

#include "trismooth/base/workers.h"
#include "trismooth/mesh_io/bytes/buffered_writer.h"
#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Writes blocks 0 to `count` - 1 to `writer`, one behind the other. `encode`(block, bytes) fills `bytes`, which it
/// gets empty, with a block: on any worker, many at a time, while others are written. Memory: a few blocks a worker.
/// What `encode` throws is passed on, and WriteError.
class OrderedBlocks {
 public:
  OrderedBlocks(BufferedWriter& writer, Workers& workers) : writer_(writer), workers_(workers) {}

  template <class Encode>
  void write(std::size_t count, const Encode& encode) {
    write_all(count, {&encode, [](const void* object, std::size_t block, MemoryBlock& bytes) {
                        (*static_cast<const Encode*>(object))(block, bytes);
                      }});
  }

 private:
  /// A function object of any type: what calls it is compiled once.
  struct AnyEncode {
    const void* object;
    void (*call)(const void* object, std::size_t block, MemoryBlock& bytes);
  };

  void write_all(std::size_t count, const AnyEncode& encode);

  BufferedWriter& writer_;
  Workers& workers_;
};

}  // namespace trismooth
