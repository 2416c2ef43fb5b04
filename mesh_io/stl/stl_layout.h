#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

// Binary STL: a title, the number of facets, and of each facet a normal, three corners and an attribute.
namespace trismooth::stl_layout {

inline constexpr std::size_t title_bytes = 80;
inline constexpr std::size_t header_bytes = title_bytes + sizeof(std::uint32_t);
inline constexpr std::size_t vector_bytes = 3 * sizeof(float);
inline constexpr std::size_t facet_bytes = 4 * vector_bytes + sizeof(std::uint16_t);

/// The little-endian number at `offset`, which must be within `bytes`.
template <class T>
T number_at(std::string_view bytes, std::size_t offset) {
  std::array<char, sizeof(T)> stored{};
  std::memcpy(stored.data(), bytes.data() + offset, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) {
    std::ranges::reverse(stored);
  }
  return std::bit_cast<T>(stored);
}

}  // namespace trismooth::stl_layout
