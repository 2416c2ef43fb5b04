// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Takes the bytes of a file from front to back: a BufferedWriter, a stream, a string.
using ByteSink = std::function<void(std::string_view)>;

/// Encodes blocks on all workers and hands them to a sink in their order.
class OrderedBlocks {
 public:
  /// `workers` and what the sink refers to must outlive it.
  OrderedBlocks(ByteSink sink, const FileWorkers& workers) : sink_(std::move(sink)), workers_(workers) {}

  /// Hands blocks 0 to `count` - 1 to the sink, one behind the other. `encode`(block, bytes) fills `bytes`, which it
  /// gets empty, with a block: on any worker, many at a time, while others are handed on. Memory: a few blocks a
  /// worker, kept for the next call. The first exception of `encode` or the sink, in the order of the blocks, is passed
  /// on.
  template <class Encode>
  void write(std::size_t count, const Encode& encode) {
    write_all(count, {&encode, [](const void* object, std::size_t block, MemoryBlock& bytes) {
                        (*static_cast<const Encode*>(object))(block, bytes);
                      }});
  }

  /// write() of rows 0 to `count` - 1 in blocks of them: `encode`(begin, end, bytes) appends those from `begin` to
  /// before `end` to `bytes`. A row takes about `row_bytes`, which decides on the size of the blocks and on nothing
  /// else.
  template <class Encode>
  void write_rows(std::size_t count, std::size_t row_bytes, const Encode& encode) {
    const std::size_t rows =
        std::max(std::size_t{1}, std::min(workers_.part_bytes, FileWorkers::default_part_bytes) / row_bytes);
    write(count / rows + (count % rows == 0 ? 0 : 1), [&](std::size_t block, MemoryBlock& bytes) {
      encode(block * rows, std::min(count, (block + 1) * rows), bytes);
    });
  }

  /// Hands bytes on as they are.
  void write(std::string_view bytes) { sink_(bytes); }

 private:
  /// A function object of any type: what calls it is compiled once.
  struct AnyEncode {
    const void* object;
    void (*call)(const void* object, std::size_t block, MemoryBlock& bytes);
  };

  /// In cache lines of its own: its size changes with every number, and threads would take it from each other.
  struct alignas(128) Buffer {
    MemoryBlock bytes;
  };

  void write_all(std::size_t count, const AnyEncode& encode);

  ByteSink sink_;
  FileWorkers workers_;
  std::vector<Buffer> buffers_;
};

}  // namespace trismooth
