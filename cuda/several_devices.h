// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "trismooth/smoothing/backend.h"

namespace trismooth::cuda {

/// The backend of two devices or more, see backend_on(): all are there.
std::unique_ptr<Backend> backend_on_several(std::span<const int> devices);

}  // namespace trismooth::cuda
