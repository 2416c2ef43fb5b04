// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The text as HTML shows it literally, in content and in attribute values alike. What is not harmless (see
/// printable_text.h) becomes U+FFFD: no page may hold control characters, nor bytes that are no UTF-8.
std::string escape_html(std::string_view text);

}  // namespace trismooth
