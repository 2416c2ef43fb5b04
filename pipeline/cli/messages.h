// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "trismooth/base/text/printable_text.h"

namespace trismooth {

/// In one piece, or not at all where there is no memory for it.
inline void print_message(std::ostream& stream, std::string_view kind, std::string_view message) {
  const std::string line = std::string("trismooth: ").append(kind).append(": ").append(printable(message)).append("\n");
  // A message that there was no memory to write does not silence the next one.
  stream.clear();
  stream << line;
}

/// The messages of the command line, one a line whatever they name: "trismooth: error: plate.off:17: expected 3
/// coordinates".
inline void print_error(std::ostream& stream, std::string_view message) {
  print_message(stream, "error", message);
}
inline void print_warning(std::ostream& stream, std::string_view message) {
  print_message(stream, "warning", message);
}
inline void print_note(std::ostream& stream, std::string_view message) {
  print_message(stream, "note", message);
}

}  // namespace trismooth
