// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

std::string FreeNames::claim(std::string_view wanted) {
  if (taken_.emplace(wanted).second) {
    return std::string(wanted);
  }
  std::size_t& number = next_numbers_.try_emplace(std::string(wanted), 1).first->second;
  for (;;) {
    std::string candidate = std::string(wanted) + "_" + std::to_string(number++);
    if (taken_.insert(candidate).second) {
      return candidate;
    }
  }
}

}  // namespace trismooth
