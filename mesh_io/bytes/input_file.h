// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>

#include "trismooth/mesh_io/bytes/file_bytes.h"

namespace trismooth {

/// A file that is open for reading.
class InputFile {
 public:
  /// Throws ReadError where it cannot be opened.
  explicit InputFile(std::filesystem::path path);
  /// Of the file that is open under that number.
  InputFile(std::filesystem::path path, int descriptor);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  const std::filesystem::path& path() const { return path_; }

  /// Of a regular file; 0 of all else, whose size says nothing.
  std::size_t size() const;

  /// Reads up to `count` bytes from `offset` on; fewer where the file ends. Throws ReadError.
  std::size_t read_at(std::byte* bytes, std::size_t count, std::size_t offset) const;
  /// Reads up to `count` bytes from where its last call ended: for pipes too. Throws ReadError.
  std::size_t read_on(std::byte* bytes, std::size_t count) const;
  /// The bytes [begin, end), fewer where the file ends.
  FileBytes read_range(std::size_t begin, std::size_t end) const;

  void seek(std::size_t offset) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace trismooth
