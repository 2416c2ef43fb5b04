// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

#include "trismooth/base/array_layout.h"

namespace trismooth {

/// Numbers of the caller, float or double, of anything contiguous (std::vector, std::array, std::span, ...), read when
/// they are needed. Nothing is copied; the caller keeps the memory for as long as the view is used. A temporary that
/// owns its numbers is not taken: they would be gone with it.
class RealView {
 public:
  /// No numbers.
  constexpr RealView() = default;

  /// A view of these numbers.
  template <class R>
  requires array_layout::ContiguousRange<R> && array_layout::Lasting<R> &&
      std::is_convertible_v<R&&, std::span<const double>>
  constexpr RealView(R&& numbers) : of_double_(numbers) {}
  /// A view of these numbers.
  template <class R>
  requires array_layout::ContiguousRange<R> && array_layout::Lasting<R> &&
      std::is_convertible_v<R&&, std::span<const float>>
  constexpr RealView(R&& numbers) : of_float_(numbers) {}

  /// How many there are.
  [[nodiscard]] constexpr std::size_t size() const { return of_double_.size() + of_float_.size(); }
  /// Whether there are none.
  [[nodiscard]] constexpr bool empty() const { return size() == 0; }
  /// Number i, as double. Complexity: constant.
  [[nodiscard]] constexpr double operator[](std::size_t i) const {
    return of_float_.empty() ? of_double_[i] : static_cast<double>(of_float_[i]);
  }
  /// A copy of them. Complexity: linear.
  [[nodiscard]] std::vector<double> listed() const {
    std::vector<double> numbers(size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = (*this)[i];
    }
    return numbers;
  }

 private:
  std::span<const double> of_double_;  ///< one of these is empty
  std::span<const float> of_float_;
};

}  // namespace trismooth
