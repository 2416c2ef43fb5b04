// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth {

/// How a file writes the numbers for which it has few characters.
enum class NumberForm : std::uint8_t {
  usual,   ///< 0.001, 1.5e-05
  nastran  ///< always with a decimal point, no zero before it, no letter before an exponent: .001, 1.5-5
};

}  // namespace trismooth
