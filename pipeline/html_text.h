#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The text as HTML shows it literally, in content and in attribute values alike. Control characters, which no page may
/// hold, become U+FFFD.
std::string escape_html(std::string_view text);

}  // namespace trismooth
