// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// Writes a plain file in large blocks; every failure is a WriteError that names the file and the cause.
class BufferedWriter {
 public:
  explicit BufferedWriter(const std::filesystem::path& path);
  BufferedWriter(const BufferedWriter&) = delete;
  BufferedWriter& operator=(const BufferedWriter&) = delete;
  ~BufferedWriter();

  void write(std::string_view bytes);
  /// Closes the file; without it the destructor closes it and errors go unseen.
  void close();

 private:
  void flush();
  void write_out(std::string_view bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  MemoryBlock block_;
  std::size_t used_ = 0;  ///< of the block
  int descriptor_;
};

}  // namespace trismooth
