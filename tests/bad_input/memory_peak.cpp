// SPDX-License-Identifier: BSD-3-Clause
#include "memory_peak.h"

#include <algorithm>
#include <atomic>
#include <cerrno>

#include <malloc.h>

#include "support/sanitized.h"

#ifdef TRISMOOTH_SANITIZED
#include <sanitizer/allocator_interface.h>
#endif

namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> most_held{0};

void note_more(std::size_t bytes) {
  const std::size_t now = held += bytes;
  // Tests run in one thread; others only start and end.
  most_held = std::max(most_held.load(), now);
}

}  // namespace

#ifdef TRISMOOTH_SANITIZED

namespace {

void on_malloc(const volatile void* /*memory*/, std::size_t size) {
  note_more(size);
}
void on_free(const volatile void* memory) {
  held -= __sanitizer_get_allocated_size(memory);
}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(&on_malloc, &on_free);

}  // namespace

#else

// The functions of the C library under other names, which it keeps for such use.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void __libc_free(void* memory);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) {
  void* const memory = __libc_malloc(size);
  note_more(malloc_usable_size(memory));
  return memory;
}

void* calloc(std::size_t count, std::size_t size) {
  void* const memory = __libc_calloc(count, size);
  note_more(malloc_usable_size(memory));
  return memory;
}

void* realloc(void* memory, std::size_t size) {
  const std::size_t before = malloc_usable_size(memory);
  void* const moved = __libc_realloc(memory, size);
  if (moved != nullptr || size == 0) {
    note_more(malloc_usable_size(moved));
    held -= before;
  }
  return moved;
}

void free(void* memory) {
  held -= malloc_usable_size(memory);
  __libc_free(memory);
}
}

#endif

MemoryPeak::MemoryPeak() : held_before_(held) {
  most_held = held_before_;
}

std::size_t MemoryPeak::bytes() const {
  return most_held - held_before_;
}
