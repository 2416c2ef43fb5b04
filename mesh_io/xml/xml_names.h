// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace trismooth {

/// The text in characters that XML can hold: control characters replaced by '?', but for tabs and line ends. Bytes that
/// are not UTF-8 are taken for Latin-1.
std::string as_xml_text(std::string_view text);

/// The name as the value of an XML attribute: markup, quotes and line ends escaped, control characters that XML cannot
/// hold replaced by '?'. Bytes that are not UTF-8 are taken for Latin-1.
std::string escape_xml_attribute(std::string_view name);

}  // namespace trismooth
