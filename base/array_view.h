#pragma once

#include <span>
#include <type_traits>

#include "trismooth/base/array_layout.h"

namespace trismooth {

/// A span of the caller's numbers. Everything contiguous that keeps numbers of this type converts to it by itself:
/// std::vector, std::array, std::span, ... A temporary that owns its numbers is not taken: they would be gone with it.
/// Nothing is copied; the caller keeps the memory for as long as the view is used.
template <class T>
class ArrayView : public std::span<const T> {
 public:
  /// No numbers.
  constexpr ArrayView() = default;

  /// A view of these numbers.
  template <class R>
  requires array_layout::ContiguousRange<R> && array_layout::Lasting<R> &&
      std::is_convertible_v<R&&, std::span<const T>>
  constexpr ArrayView(R&& numbers) : std::span<const T>(numbers) {}
};

}  // namespace trismooth
