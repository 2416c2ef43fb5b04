// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace trismooth {

/// The processor's model name as the system gives it ("AMD EPYC ..."), or "unknown processor".
std::string processor_name();

}  // namespace trismooth
