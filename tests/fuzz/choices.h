// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "trismooth/base/splitmix64.h"
#include "trismooth/smoothing/method.h"

namespace fuzz {

/// All methods, mean-ratio second: the inputs that are kept have chosen in this order.
inline auto all_methods() {
  auto methods = trismooth::values_of<trismooth::Method>();
  std::rotate(methods.begin() + 1, std::ranges::find(methods, trismooth::Method::mean_ratio),
              std::ranges::find(methods, trismooth::Method::mean_ratio) + 1);
  return methods;
}

/// Choices made from the bytes of an input, front to back; zeros where they have ended.
class InputBytes {
 public:
  explicit InputBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) {
      return 0;
    }
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  bool flag() { return byte() % 2 == 1; }
  /// 0 .. bound - 1; bound is 1 to 256.
  int below(int bound) { return byte() % bound; }
  template <class T, std::size_t count>
  T one_of(const T (&values)[count]) {
    return values[below(static_cast<int>(count))];
  }
  template <class T, std::size_t count>
  T one_of(const std::array<T, count>& values) {
    return values[below(static_cast<int>(count))];
  }
  template <class T>
  T raw() {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    for (std::uint8_t& each : bytes) {
      each = byte();
    }
    return std::bit_cast<T>(bytes);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Choices made from a hash, where the input has its own meaning.
class HashedChoices {
 public:
  explicit HashedChoices(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      state_ = (state_ ^ byte) * 0x100000001b3U;  // FNV-1a
    }
  }
  explicit HashedChoices(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() { return state_ = trismooth::splitmix64(state_); }
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }
  bool flag() { return below(2) == 1; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

}  // namespace fuzz
