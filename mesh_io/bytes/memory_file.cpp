// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/memory_file.h"

#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

MemoryFile::MemoryFile(const std::filesystem::path& target) : descriptor_(::memfd_create("mesh", MFD_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw WriteError(target, std::string("cannot be written: no file in memory: ") + std::strerror(errno));
  }
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() {
  if (mapped_ != nullptr) {
    ::munmap(mapped_, size_);
  }
  ::close(descriptor_);
}

std::string_view MemoryFile::view() {
  struct stat status {};
  if (mapped_ == nullptr && ::fstat(descriptor_, &status) == 0 && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor_, 0);
    if (mapped == MAP_FAILED) {
      throw std::bad_alloc();
    }
    mapped_ = mapped;
    size_ = size;
  }
  return {static_cast<const char*>(mapped_), size_};
}

}  // namespace trismooth
