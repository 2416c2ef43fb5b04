// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <new>
#include <ostream>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/bytes/broken_pipe.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/cli/messages.h"

namespace trismooth {

/// Calls write(), which writes that file, and answers whether it could: one that cannot be written is told on `err`,
/// and keeps no other from being written.
template <class Write>
bool could_write(const std::filesystem::path& file, std::ostream& err, const Write& write) {
  try {
    write();
    return true;
  } catch (const WriteError& error) {
    print_error(err, error.what());
  } catch (const std::bad_alloc&) {
    print_error(err, file.string() + ": cannot be written: not enough memory");
  }
  return false;
}

/// Throws WriteError, which names the standard output, where it has failed; errno says why, 0 that nobody knows.
inline void require_printed(const std::ostream& stream) {
  if (!stream) {
    throw WriteError("standard output",
                     "cannot be written" + (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()));
  }
}

/// Writes out what was printed so far. Throws WriteError, which names the standard output, where that fails.
inline void flush_results(std::ostream& stream) {
  errno = 0;
  stream.flush();
  require_printed(stream);
}

/// Prints that and writes it out. Throws WriteError, which names the standard output, where that fails.
inline void print_results(std::ostream& stream, std::string_view text) {
  errno = 0;
  stream << text << std::flush;
  require_printed(stream);
}

/// print_results() before files take their places. Answers false where whoever read the standard output has gone away:
/// that is the reader's choice (head), and keeps no file from being written. The program ends by end_without_reader()
/// then.
inline bool print_before_files(std::ostream& stream, std::string_view text) {
  const BrokenPipeIsError this_thread;
  try {
    print_results(stream, text);
  } catch (const WriteError&) {
    if (errno != EPIPE) {
      throw;
    }
    return false;
  }
  return true;
}

/// Ends the program as one whose standard output has lost its reader. Throws WriteError where the signal for it is
/// ignored.
[[noreturn]] inline void end_without_reader() {
  std::raise(SIGPIPE);
  throw WriteError("standard output", std::string("cannot be written: ") + std::strerror(EPIPE));
}

}  // namespace trismooth
