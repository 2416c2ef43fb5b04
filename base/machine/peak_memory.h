// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <sys/resource.h>

namespace trismooth {

/// The most memory that this process has had so far.
inline std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace trismooth
