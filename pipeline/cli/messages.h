#pragma once

#include <ostream>
#include <string_view>

#include "trismooth/pipeline/report/printable_text.h"

namespace trismooth {

/// The messages of the command line, one a line whatever they name: "trismooth: error: plate.off:17: expected 3
/// coordinates".
inline void print_error(std::ostream& stream, std::string_view message) {
  stream << "trismooth: error: " << printable(message) << '\n';
}
inline void print_warning(std::ostream& stream, std::string_view message) {
  stream << "trismooth: warning: " << printable(message) << '\n';
}
inline void print_note(std::ostream& stream, std::string_view message) {
  stream << "trismooth: note: " << printable(message) << '\n';
}

}  // namespace trismooth
