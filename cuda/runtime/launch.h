// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::cuda {

/// Threads of a block where nothing speaks for another number.
inline constexpr unsigned block_size = 256;

/// Blocks for one thread each of `count` elements.
constexpr unsigned blocks_for(std::int64_t count, unsigned threads = block_size) {
  return static_cast<unsigned>((count + threads - 1) / threads);
}

}  // namespace trismooth::cuda
