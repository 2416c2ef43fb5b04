// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/bulk_memory.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace trismooth {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21U;
constexpr std::size_t many_bytes = large_page;

#ifdef __linux__

/// Rounded up to large pages.
constexpr std::size_t mapped_bytes(std::size_t bytes) {
  return (bytes + large_page - 1) / large_page * large_page;
}

/// From the system, and back to it as soon as it is released: the C library keeps what is freed, in pieces into which
/// the next array may not fit.
void* memory_of_system(std::size_t bytes) {
  const std::size_t mapped = mapped_bytes(bytes);
  void* const first = ::mmap(nullptr, mapped + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (first == MAP_FAILED) {
    throw std::bad_alloc();
  }
  // What is before the large pages and behind them goes back at once.
  auto* const begin = static_cast<std::byte*>(first);
  const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(begin) % large_page) % large_page;
  if (before > 0) {
    ::munmap(begin, before);
  }
  ::munmap(begin + before + mapped, large_page - before);
  std::byte* const memory = begin + before;
  prefer_large_pages(memory, bytes);
  return memory;
}

#endif

}  // namespace

void prefer_large_pages([[maybe_unused]] void* first, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // Whole pages alone: what is before and behind them is no larger than one.
  const std::size_t before = (large_page - reinterpret_cast<std::uintptr_t>(first) % large_page) % large_page;
  if (before + large_page <= bytes) {
    // A system that has no large pages says so, and gives its usual ones.
    static_cast<void>(
        ::madvise(static_cast<std::byte*>(first) + before, (bytes - before) / large_page * large_page, MADV_HUGEPAGE));
  }
#endif
}

void* bulk_memory(std::size_t bytes) {
  if (bytes < many_bytes) {
    return ::operator new(bytes);
  }
#ifdef __linux__
  return memory_of_system(bytes);
#else
  return ::operator new (bytes, std::align_val_t{large_page});
#endif
}

void release_bulk_memory(void* memory, std::size_t bytes) noexcept {
  if (bytes < many_bytes) {
    ::operator delete(memory);
    return;
  }
#ifdef __linux__
  ::munmap(memory, mapped_bytes(bytes));
#else
  ::operator delete (memory, std::align_val_t{large_page});
#endif
}

}  // namespace trismooth
