// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// The first characters of a file, behind a byte-order mark: all that has to show of which format it is.
inline std::string_view text_head(std::string_view bytes) {
  constexpr std::size_t enough = std::size_t{1} << 16;
  return bytes.substr(begin_of_text(bytes), enough);
}

}  // namespace trismooth
