// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "trismooth/base/errors.h"

namespace test_support {

/// What is said of a call that is refused, and whether of its arguments or of the mesh; "none" where it is not.
template <class Function>
std::string refusal(const Function& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return std::string("argument: ") + error.what();
  } catch (const trismooth::MeshError& error) {
    return std::string("mesh: ") + error.what();
  }
  return "none";
}

}  // namespace test_support
