// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/host_device.h"

namespace trismooth {

/// The output function of SplitMix64 (Steele, Lea and Flood 2014): a bijection that scatters consecutive numbers.
constexpr TRISMOOTH_HOST_DEVICE std::uint64_t splitmix64(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

/// The order in which Form B colours vertices: a before b. splitmix64 is a bijection, so there are no ties.
constexpr TRISMOOTH_HOST_DEVICE bool coloured_before(std::int64_t a, std::int64_t b) {
  return splitmix64(static_cast<std::uint64_t>(a)) < splitmix64(static_cast<std::uint64_t>(b));
}

}  // namespace trismooth
