#pragma once

#include <ostream>
#include <string_view>

namespace trismooth {

/// The messages of the command line, one a line: "trismooth: error: plate.off:17: expected 3 coordinates".
inline void print_error(std::ostream& stream, std::string_view message) {
  stream << "trismooth: error: " << message << '\n';
}
inline void print_warning(std::ostream& stream, std::string_view message) {
  stream << "trismooth: warning: " << message << '\n';
}
inline void print_note(std::ostream& stream, std::string_view message) {
  stream << "trismooth: note: " << message << '\n';
}

}  // namespace trismooth
