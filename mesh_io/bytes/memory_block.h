// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include <sys/mman.h>

namespace trismooth {

/// Asks for large pages for memory that is about to be filled: the system hands it out in hundreds of steps less. Small
/// blocks, and systems without large pages, are left as they are.
inline void prefer_large_pages(const void* begin, std::size_t bytes) {
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const std::uintptr_t last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
  if (first < last) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): nobody reads through it
    ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  }
}

/// Bytes from malloc() that can grow at the end and can be handed to a library that calls free() on them.
class MemoryBlock {
 public:
  std::size_t size() const { return size_; }
  std::byte* data() { return data_.get(); }
  const std::byte* data() const { return data_.get(); }

  /// Makes room for `count` bytes more at the end and returns where they start; they are not initialised. Capacity
  /// doubles, so many small steps cost little. Throws std::bad_alloc.
  std::byte* extend(std::size_t count) {
    if (count > capacity_ - size_) {
      reallocate(std::max(size_ + count, 2 * capacity_));
    }
    std::byte* const begin = data_.get() + size_;
    size_ += count;
    return begin;
  }

  /// Appends so many bytes, which are not of this block. Throws std::bad_alloc.
  void append(const void* bytes, std::size_t count) {
    std::byte* const target = extend(count);
    if (count > 0) {
      std::memcpy(target, bytes, count);
    }
  }

  /// Makes room for `count` bytes more: exactly, if these are the first ones; else capacity doubles at least, so that
  /// many small steps cost little. Throws std::bad_alloc.
  void reserve_more(std::size_t count) {
    if (count > capacity_ - size_) {
      reallocate(std::max(size_ + count, 2 * size_));
    }
  }

  /// Drops what is behind the first `size` bytes, if there is more.
  void truncate(std::size_t size) { size_ = std::min(size_, size); }

  void shrink_to_fit() {
    if (size_ != 0 && size_ != capacity_) {
      reallocate(size_);
    }
  }

  /// Hands the bytes over: the caller calls free(). The block is empty then.
  std::byte* release() {
    size_ = 0;
    capacity_ = 0;
    return data_.release();
  }

 private:
  struct Free {
    void operator()(std::byte* bytes) const { std::free(bytes); }
  };

  void reallocate(std::size_t capacity) {
    auto* const bytes = static_cast<std::byte*>(std::realloc(data_.get(), capacity));
    if (bytes == nullptr) {
      throw std::bad_alloc();
    }
    [[maybe_unused]] std::byte* const moved_from = data_.release();
    data_.reset(bytes);
    capacity_ = capacity;
    prefer_large_pages(bytes, capacity);
  }

  std::unique_ptr<std::byte, Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Throws std::bad_alloc where so much more memory cannot be had: in front of code that does not bear it well when it
/// runs out of memory half-way (VTK; destructors that need some). Costs nothing where it can.
inline void require_host_memory(std::size_t bytes) {
  void* volatile const tried = std::malloc(bytes);  // volatile, or a compiler may leave out what nobody uses
  if (tried == nullptr) {
    throw std::bad_alloc();
  }
  std::free(tried);
}

}  // namespace trismooth
