// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/version.h"

namespace trismooth {

std::string_view library_version() {
  return TRISMOOTH_VERSION;
}

}  // namespace trismooth
