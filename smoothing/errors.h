// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

#include "trismooth/base/errors.h"

namespace trismooth {

/// A device that is not there, has too little memory, or failed.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whoever a plan was made for does not want it any more: see SmoothingOptions::cancel.
struct PlanCancelled : std::runtime_error {
  PlanCancelled() : std::runtime_error("the plan was cancelled while it was made") {}
};

/// What all parts of a mesh throw at the same time: see MeshPart.
struct PartsError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace trismooth
