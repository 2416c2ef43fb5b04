#pragma once

#include <cstddef>
#include <string_view>

#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// The first characters of a file, behind a byte-order mark: all that has to show of which format it is.
inline std::string_view text_head(std::string_view bytes) {
  constexpr std::size_t enough = std::size_t{1} << 16;
  return bytes.substr(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0, enough);
}

}  // namespace trismooth
