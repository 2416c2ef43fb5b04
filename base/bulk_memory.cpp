#include "trismooth/base/bulk_memory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace trismooth {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21U;
constexpr std::size_t many_bytes = large_page;

}  // namespace

void* bulk_memory(std::size_t bytes) {
  if (bytes < many_bytes) {
    return ::operator new(bytes);
  }
  void* const memory = ::operator new (bytes, std::align_val_t{large_page});
#ifdef MADV_HUGEPAGE
  // Whole pages of it alone: the last part shares its page with others. A system that has no large pages says so, and
  // gives its usual ones.
  static_cast<void>(::madvise(memory, bytes / large_page * large_page, MADV_HUGEPAGE));
#endif
  return memory;
}

void release_bulk_memory(void* memory, std::size_t bytes) noexcept {
  if (bytes < many_bytes) {
    ::operator delete(memory);
  } else {
    ::operator delete (memory, std::align_val_t{large_page});
  }
}

}  // namespace trismooth
