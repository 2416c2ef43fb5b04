// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace trismooth {

/// A mesh file that cannot be read, or that is not a planar triangle mesh. The message names the file and, where
/// there is one, the place in it: "plate.off:17: expected 3 coordinates, got 'abc'".
struct ReadError : std::runtime_error {
  /// Of the file as a whole.
  ReadError(const std::filesystem::path& file, const std::string& message)
      : std::runtime_error(file.string() + ": " + message) {}
  /// At a line of it, from 1.
  ReadError(const std::filesystem::path& file, std::size_t line, const std::string& message)
      : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message) {}
};

/// A file that cannot be written. The message names it; what stood there before is untouched.
struct WriteError : std::runtime_error {
  /// `message` without the file's name.
  WriteError(const std::filesystem::path& file, const std::string& message)
      : std::runtime_error(file.string() + ": " + message), reason(message) {}

  std::string reason;  ///< the message without the file
};

}  // namespace trismooth
