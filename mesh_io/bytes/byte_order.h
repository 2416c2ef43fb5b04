// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace trismooth {

/// The number with its bytes in reverse order.
template <class T>
T with_bytes_reversed(T number) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(number);
  std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

/// A number of this machine's byte order in that one, and back.
template <std::endian order, class T>
T in_byte_order(T number) {
  return order == std::endian::native ? number : with_bytes_reversed(number);
}

/// The number whose bytes, in that order, begin at `bytes`; there are sizeof(T) of them (no check).
template <std::endian order, class T>
T load(const char* bytes) {
  T number;
  std::memcpy(&number, bytes, sizeof(T));
  return in_byte_order<order>(number);
}

}  // namespace trismooth
