// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"

namespace trismooth {

/// Calls body(begin, end) on blocks of [0, size), on all workers, each of about a part's bytes where an element takes
/// `bytes_each`.
template <class Body>
void for_file_blocks(const FileWorkers& workers, std::size_t size, std::size_t bytes_each, const Body& body) {
  const bool in_parts = workers.part_bytes != FileWorkers::serial && workers.part_bytes != FileWorkers::whole;
  const std::size_t grain =
      in_parts ? std::max(std::size_t{1}, workers.part_bytes / bytes_each) : std::max(std::size_t{1}, size);
  const std::size_t blocks = size / grain + (size % grain == 0 ? 0 : 1);
  workers.workers.for_blocks(static_cast<std::int64_t>(blocks), 1, [&](std::int64_t first, std::int64_t last) {
    for (auto block = static_cast<std::size_t>(first); block < static_cast<std::size_t>(last); ++block) {
      body(block * grain, std::min(size, (block + 1) * grain));
    }
  });
}

/// True where body(begin, end) is true for all such blocks; some may be left out where it is not.
template <class Body>
bool all_file_blocks(const FileWorkers& workers, std::size_t size, std::size_t bytes_each, const Body& body) {
  std::atomic<bool> all = true;
  for_file_blocks(workers, size, bytes_each, [&](std::size_t begin, std::size_t end) {
    if (all && !body(begin, end)) {
      all = false;
    }
  });
  return all;
}

/// The first i below `size` that is_wrong(i), or `size`, by all workers; an element takes `bytes_each`.
template <class IsWrong>
std::size_t first_wrong(const FileWorkers& workers, std::size_t size, std::size_t bytes_each, const IsWrong& is_wrong) {
  std::atomic<std::size_t> first = size;
  for_file_blocks(workers, size, bytes_each, [&](std::size_t begin, std::size_t end) {
    // Nearly always none is: without a branch for each the compiler can look at several at once.
    bool any = false;
    for (std::size_t i = begin; i < end; ++i) {
      any |= is_wrong(i);
    }
    for (std::size_t i = begin; any && i < end; ++i) {
      if (is_wrong(i)) {
        for (std::size_t other = first; i < other && !first.compare_exchange_weak(other, i);) {
        }
        break;
      }
    }
  });
  return first;
}

/// Appends the bytes to the block.
inline void append_shared(MemoryBlock& block, const void* bytes, std::size_t count, const FileWorkers& workers) {
  block.reserve_more(count);
  std::byte* const target = block.extend(count);
  for_file_blocks(workers, count, 1, [&](std::size_t begin, std::size_t end) {
    std::memcpy(target + begin, static_cast<const std::byte*>(bytes) + begin, end - begin);
  });
}

}  // namespace trismooth
