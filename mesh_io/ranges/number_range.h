// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth {

/// Numbers from `first` to before `last`.
struct NumberRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

}  // namespace trismooth
