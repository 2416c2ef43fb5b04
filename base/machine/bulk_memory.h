// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace trismooth {

/// Memory for `bytes` bytes. Where these are many, it begins at a large page, and the system is asked for such pages: a
/// pass over it meets hundreds of times fewer of them. Throws std::bad_alloc. Release it with release_bulk_memory().
void* bulk_memory(std::size_t bytes);

/// Releases what bulk_memory() gave for so many bytes.
void release_bulk_memory(void* memory, std::size_t bytes) noexcept;

/// Asks the system for large pages for memory that somebody else has reserved and not written to yet: `bytes` bytes
/// from `first` on. Nothing but speed depends on it.
void prefer_large_pages(void* first, std::size_t bytes) noexcept;

/// Gives containers bulk_memory(), and leaves elements that are made without a value as the memory is.
template <class T>
struct BulkAllocator {
  using value_type = T;

  BulkAllocator() = default;
  template <class U>
  constexpr BulkAllocator(const BulkAllocator<U>& /*other*/) noexcept {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t count) { return static_cast<T*>(bulk_memory(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { release_bulk_memory(memory, count * sizeof(T)); }
  template <class U>
  void construct(U* /*place*/) noexcept {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const BulkAllocator& /*a*/, const BulkAllocator& /*b*/) { return true; }
};

/// A vector for numbers of a whole mesh: resize() leaves the new elements without a value, so no thread writes what all
/// of them are about to write. Whoever makes it larger writes every element before it is read.
template <class T>
using BulkVector = std::vector<T, BulkAllocator<T>>;

/// Whether they hold the same.
template <class T>
bool operator==(const BulkVector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace trismooth
