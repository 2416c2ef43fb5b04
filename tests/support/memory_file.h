// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace test_support {

/// A regular file that is in memory only, with a path: for writers, which write to paths.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("mesh", MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw std::system_error(errno, std::generic_category(), "memfd_create");
    }
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  const std::filesystem::path& path() const { return path_; }

  std::string bytes() const {
    struct stat status {};
    ::fstat(descriptor_, &status);
    std::string all(static_cast<std::size_t>(status.st_size), '\0');
    const ssize_t got = ::pread(descriptor_, all.data(), all.size(), 0);
    if (got != static_cast<ssize_t>(all.size())) {
      throw std::system_error(errno, std::generic_category(), "pread");
    }
    return all;
  }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace test_support
