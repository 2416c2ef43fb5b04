#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace trismooth {

/// The number whose big-endian bytes begin at `bytes`; there are sizeof(T) of them (no check).
template <class T>
T load_big_endian(const char* bytes) {
  std::array<char, sizeof(T)> stored{};
  std::memcpy(stored.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::little) {
    std::ranges::reverse(stored);
  }
  return std::bit_cast<T>(stored);
}

}  // namespace trismooth
