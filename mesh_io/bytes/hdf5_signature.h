// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace trismooth {

/// Whether the bytes are an HDF5 file by its signature: at the beginning, or behind a block of a program's own, which
/// has some power of two of bytes.
inline bool is_hdf5(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::size_t first_place = 512;
  for (std::size_t at = 0; at < bytes.size(); at = std::max(first_place, 2 * at)) {
    if (bytes.substr(at).starts_with("\x89HDF\r\n\x1a\n"sv)) {
      return true;
    }
  }
  return false;
}

/// Whether they are one in which that name stands, as names of groups and datasets do. Nothing else is looked at: what
/// a damaged file makes of the library is left to those who read it.
inline bool is_hdf5_with(std::string_view bytes, std::string_view name) {
  return is_hdf5(bytes) && bytes.find(name) != bytes.npos;
}

}  // namespace trismooth
