// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trismooth/base/array_layout.h"

namespace trismooth {

namespace array_layout {

/// Numbers that ids and tags of type T may be given as: whole ones of another type.
template <class R, class T>
concept OtherIntegers = ContiguousRange<R> && Lasting<R> && std::integral<T> &&(sizeof(T) > 1) &&
                        std::integral<std::ranges::range_value_t<R>> &&
                        !std::same_as<std::ranges::range_value_t<R>, bool> &&
                        !std::is_convertible_v<R&&, std::span<const T>>;

}  // namespace array_layout

/// A span of the caller's numbers. Everything contiguous that keeps numbers of this type converts to it by itself:
/// std::vector, std::array, std::span, ... A temporary that owns its numbers is not taken: they would be gone with it.
/// Nothing is copied; the caller keeps the memory for as long as the view is used. Of whole numbers of another type
/// than the view's (its own of 32 or 64 bits) a copy is made, which the view and its copies keep.
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

  /// A view of a copy of these whole numbers. Throws std::invalid_argument for one that has no place in T. Complexity:
  /// linear.
  template <class R>
  requires array_layout::OtherIntegers<R, T> ArrayView(R&& numbers) : ArrayView(converted(numbers)) {}

  /// For the sake of its message.
  template <class R>
  requires std::same_as<std::remove_cvref_t<R>, std::vector<bool>> ArrayView(R&& /*flags*/) {
    static_assert(!std::same_as<std::remove_cvref_t<R>, std::vector<bool>>,
                  "trismooth: std::vector<bool> has its flags in bits, not as numbers in memory: keep them in a "
                  "std::vector<std::uint8_t>");
  }

 private:
  using Copy = std::shared_ptr<const std::vector<T>>;

  explicit ArrayView(Copy copy) : std::span<const T>(*copy), copy_(std::move(copy)) {}

  template <class R>
  static Copy converted(const R& numbers) {
    std::vector<T> copy;
    copy.reserve(std::size(numbers));
    for (const auto number : numbers) {
      if constexpr (sizeof(number) >= sizeof(T)) {
        if (!std::in_range<T>(number)) {
          throw std::invalid_argument("number " + std::to_string(copy.size()) + " of an array is " +
                                      std::to_string(number) + ", which has no place in " +
                                      std::to_string(8 * sizeof(T)) + " bits");
        }
      }
      copy.push_back(static_cast<T>(number));
    }
    return std::make_shared<const std::vector<T>>(std::move(copy));
  }

  Copy copy_;
};

}  // namespace trismooth
