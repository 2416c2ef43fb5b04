// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/processor_name.h"

#include <fstream>
#include <string_view>

namespace trismooth {

std::string processor_name() {
  static const std::string name = [] {
    std::ifstream info("/proc/cpuinfo");
    constexpr std::string_view key = "model name";
    for (std::string line; std::getline(info, line);) {
      const std::size_t colon = line.find(": ");
      if (line.starts_with(key) && colon != std::string::npos) {
        return line.substr(colon + 2);
      }
    }
    return std::string("unknown processor");
  }();
  return name;
}

}  // namespace trismooth
