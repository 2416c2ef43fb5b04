// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>

#include "trismooth/base/host_device.h"

namespace trismooth::cuda {

/// A number for each double that falls as the double rises and is never 0. So an atomic maximum of keys, which begins
/// with 0 for "nothing yet", finds the smallest double.
TRISMOOTH_HOST_DEVICE inline unsigned long long falling_key(double value) {
  constexpr unsigned long long sign = 1ULL << 63U;
  const auto bits = std::bit_cast<unsigned long long>(value);
  return (bits & sign) != 0 ? bits : ~(bits | sign);
}
/// The double of a key.
TRISMOOTH_HOST_DEVICE inline double from_falling_key(unsigned long long key) {
  constexpr unsigned long long sign = 1ULL << 63U;
  return std::bit_cast<double>((key & sign) != 0 ? key : ~key & ~sign);
}

}  // namespace trismooth::cuda
