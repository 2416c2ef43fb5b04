// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#ifdef __GLIBC__
#include <malloc.h>
#endif

/// How much more memory the process has had at its most than when this was made, in bytes, as Linux counts it. Of what
/// was freed before, nothing is there any more for others to take. One at a time.
class MemoryGrowth {
 public:
  /// Throws std::runtime_error where the system does not count it.
  MemoryGrowth() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    std::ofstream most("/proc/self/clear_refs");
    most << "5" << std::flush;  // the most is what there is now
    if (!most) {
      throw std::runtime_error("/proc/self/clear_refs cannot be written: memory is not measured");
    }
    before_ = bytes("VmRSS:");
  }

  std::int64_t most() const {
    return bytes("VmHWM:") - before_;
  }

 private:
  static std::int64_t bytes(std::string_view name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      if (word == name) {
        std::int64_t kibibytes = 0;
        status >> kibibytes;
        return 1024 * kibibytes;
      }
    }
    throw std::runtime_error("/proc/self/status does not say " + std::string(name) + " memory is not measured");
  }

  std::int64_t before_ = 0;
};
