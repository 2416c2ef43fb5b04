#pragma once

#include <cerrno>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/errors.h"

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

/// Writes out what was printed so far. Throws WriteError, which names the standard output, where that fails.
inline void flush_results(std::ostream& stream) {
  errno = 0;
  if (!stream.flush()) {
    throw WriteError("standard output",
                     "cannot be written" + (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()));
  }
}

}  // namespace trismooth
