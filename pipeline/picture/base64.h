// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The bytes as base64 (RFC 4648, section 4), without line breaks.
std::string base64(std::string_view bytes);

}  // namespace trismooth
