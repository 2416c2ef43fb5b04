// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <filesystem>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/memory_block.h"

namespace trismooth {

/// The bytes of a file, in one piece of memory. Move-only.
class FileBytes {
 public:
  FileBytes() = default;
  explicit FileBytes(MemoryBlock block) : block_(std::move(block)) {}
  /// A copy of any text: for bytes that come from no file.
  template <std::convertible_to<std::string_view> Text>
  FileBytes(const Text& text) {  // NOLINT(google-explicit-constructor): the same bytes
    const std::string_view bytes = text;
    block_.append(bytes.data(), bytes.size());
  }

  std::string_view view() const { return {reinterpret_cast<const char*>(block_.data()), block_.size()}; }
  operator std::string_view() const { return view(); }  // NOLINT(google-explicit-constructor): a view of the same
  std::size_t size() const { return block_.size(); }

 private:
  MemoryBlock block_;
};

/// The bytes of the file, large ones read in parts by all workers. Not mapped: a file that somebody cuts off while it
/// is read gives fewer bytes, no signal. Throws ReadError, also for a folder and where memory does not suffice.
FileBytes read_file_bytes(const std::filesystem::path& path, const FileWorkers& workers);

/// What comes on standard input, to its end. Throws ReadError, also where memory does not suffice.
FileBytes read_standard_input();

/// read_file_bytes() on this thread alone.
FileBytes read_file_bytes(const std::filesystem::path& path);

}  // namespace trismooth
