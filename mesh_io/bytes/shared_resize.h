// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Makes the system hand out memory that is to be filled, by all workers: what costs most of the time of filling new
/// memory. Changes no byte. Without effect where the system cannot do it.
inline void populate_memory(const void* begin, std::size_t bytes, Workers& workers) {
  prefer_large_pages(begin, bytes);
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page;
  const std::uintptr_t last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page;
  if (workers.count() > 1 && first + 1 < last) {
    workers.for_blocks(static_cast<std::int64_t>(last - first), 1, [first](std::int64_t from, std::int64_t to) {
      const std::uintptr_t at = (first + static_cast<std::uintptr_t>(from)) * page;
      // NOLINTNEXTLINE(performance-no-int-to-ptr): nobody reads through it
      ::madvise(reinterpret_cast<void*>(at), static_cast<std::size_t>(to - from) * page, MADV_POPULATE_WRITE);
    });
  }
#endif
}

/// Room for that many values: values.resize() costs little then. (For more than asked for, where it has to grow again:
/// a file may have any number of sections.)
template <class T>
void shared_reserve(std::vector<T>& values, std::size_t size, Workers& workers) {
  if (size > values.capacity()) {
    values.reserve(std::max(size, values.capacity() + values.capacity() / 2));
    populate_memory(values.data() + values.size(), (size - values.size()) * sizeof(T), workers);
  }
}

/// values.resize(size) for many values.
template <class T>
void shared_resize(std::vector<T>& values, std::size_t size, Workers& workers) {
  shared_reserve(values, size, workers);
  values.resize(size);
}

/// shared_resize() of two vectors, side by side: one thread alone fills a vector.
template <class A, class B>
void shared_resize(std::vector<A>& a, std::size_t size_of_a, std::vector<B>& b, std::size_t size_of_b,
                   Workers& workers) {
  constexpr std::size_t worth_two_threads = std::size_t{1} << 17;
  shared_reserve(a, size_of_a, workers);
  shared_reserve(b, size_of_b, workers);
  const std::int64_t grain = size_of_a + size_of_b < worth_two_threads ? 2 : 1;
  workers.for_blocks(2, grain, [&](std::int64_t first, std::int64_t last) {
    if (first == 0) {
      a.resize(size_of_a);
    }
    if (last == 2) {
      b.resize(size_of_b);
    }
  });
}

}  // namespace trismooth
