// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace trismooth {

/// A regular file that is in memory only, with a path: for writers, which write to paths.
class MemoryFile {
 public:
  /// Throws WriteError, which names `target`, where the system has none to give.
  explicit MemoryFile(const std::filesystem::path& target);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// Where to write; good as long as the file lives.
  const std::filesystem::path& path() const { return path_; }

  /// What was written up to the first call. Throws std::bad_alloc where the memory cannot be shown.
  std::string_view view();

 private:
  int descriptor_;
  std::filesystem::path path_;
  void* mapped_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace trismooth
