// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"

/// Why a vertex is held fixed: bits of one byte a vertex.
namespace trismooth::hold {

inline constexpr std::uint8_t boundary = 1;      ///< on an edge with one element
inline constexpr std::uint8_t non_manifold = 2;  ///< on an edge with three elements or more, or with copies of one
inline constexpr std::uint8_t bow_tie = 4;       ///< its elements form more than one fan
inline constexpr std::uint8_t isolated = 8;      ///< of no element
inline constexpr std::uint8_t interface = 16;    ///< on an edge between two regions
inline constexpr std::uint8_t other_cell = 32;   ///< of a cell that is no element
inline constexpr std::uint8_t named = 64;        ///< named by the user, or kept for a layer: see LayersResult
inline constexpr std::uint8_t line = 128;        ///< of a line or a link that the caller names

/// Whether a vertex held for these reasons is of no cell at all. It stays where it is, and nothing depends on where.
constexpr TRISMOOTH_HOST_DEVICE bool is_unused(std::uint8_t reasons) {
  return (reasons & (isolated | other_cell)) == isolated;
}

}  // namespace trismooth::hold

namespace trismooth {

/// Whether nothing but lines holds a vertex: a boundary, an interface, or one that the caller names.
constexpr TRISMOOTH_HOST_DEVICE bool is_held_by_lines(std::uint8_t reasons) {
  constexpr unsigned of_lines = hold::boundary | hold::interface | hold::line;
  return reasons != 0 && (reasons & ~of_lines) == 0;
}

/// Whether something else holds a vertex that is in use.
constexpr TRISMOOTH_HOST_DEVICE bool is_held_otherwise(std::uint8_t reasons) {
  return reasons != 0 && !is_held_by_lines(reasons) && !hold::is_unused(reasons);
}

}  // namespace trismooth
