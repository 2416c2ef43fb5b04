// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "trismooth/mesh_io/bytes/byte_order.h"

// Binary STL: a title, the number of facets, and of each facet a normal, three corners and an attribute.
namespace trismooth::stl_layout {

inline constexpr std::size_t title_bytes = 80;
inline constexpr std::size_t header_bytes = title_bytes + sizeof(std::uint32_t);
inline constexpr std::size_t vector_bytes = 3 * sizeof(float);
inline constexpr std::size_t facet_bytes = 4 * vector_bytes + sizeof(std::uint16_t);

/// Where the first coordinate of a corner stands.
constexpr std::size_t offset_of_corner(std::size_t corner) {
  return header_bytes + corner / 3 * facet_bytes + (1 + corner % 3) * vector_bytes;
}

/// Corners are numbered by 32-bit indices.
inline constexpr std::size_t most_facets = std::numeric_limits<std::int32_t>::max() / 3;

/// The little-endian number at `offset`, which must be within `bytes`.
template <class T>
T number_at(std::string_view bytes, std::size_t offset) {
  return load<std::endian::little, T>(bytes.data() + offset);
}

}  // namespace trismooth::stl_layout
