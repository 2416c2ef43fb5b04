#pragma once

#include "trismooth/smoothing/backend.h"

namespace trismooth {

/// The CPU backend. Layout and execution mean nothing to it; Order::unordered is refused.
const Backend& cpu_backend();

}  // namespace trismooth
