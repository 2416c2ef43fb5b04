#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/bytes/buffered_writer.h"

namespace trismooth {

/// Writes the lines of a text mesh file: words and numbers, a blank between two of one line.
class TextMeshWriter {
 public:
  explicit TextMeshWriter(const std::filesystem::path& path) : writer_(path) {}

  TextMeshWriter& word(std::string_view text);
  /// The shortest text that reads back to the same value.
  TextMeshWriter& number(double value);
  TextMeshWriter& integer(std::int64_t value);
  /// Ends the line. Throws WriteError.
  void end_line();
  /// Closes the file. Throws WriteError.
  void close();

 private:
  void separate();

  BufferedWriter writer_;
  std::string line_;
};

}  // namespace trismooth
