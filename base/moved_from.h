// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

namespace trismooth {

/// What a plan, or what else it is that `what` names, holds by a pointer. Throws std::logic_error where that is null:
/// it has been moved from.
template <class Implementation>
Implementation& not_moved_from(const std::unique_ptr<Implementation>& pointer, const char* what = "plan") {
  if (pointer == nullptr) {
    throw std::logic_error("this " + std::string(what) + " has been moved from");
  }
  return *pointer;
}

}  // namespace trismooth
