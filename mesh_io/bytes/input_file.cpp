// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

template <class Read>
std::size_t read_all(const std::filesystem::path& path, std::size_t count, const Read& read) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = read(done);
    if (got == 0) {
      break;
    }
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      throw ReadError(path, std::string("cannot be read: ") + std::strerror(errno));
    }
  }
  return done;
}

}  // namespace

InputFile::InputFile(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw ReadError(path_, std::string("cannot be opened: ") + std::strerror(errno));
  }
}

InputFile::InputFile(std::filesystem::path path, int descriptor)
    : path_(std::move(path)), descriptor_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)) {
  if (descriptor_ < 0) {
    throw ReadError(path_, std::string("cannot be read: ") + std::strerror(errno));
  }
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

std::size_t InputFile::size() const {
  struct stat status {};
  return ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
}

std::size_t InputFile::read_at(std::byte* bytes, std::size_t count, std::size_t offset) const {
  return read_all(path_, count, [&](std::size_t done) {
    return ::pread(descriptor_, bytes + done, count - done, static_cast<off_t>(offset + done));
  });
}

std::size_t InputFile::read_on(std::byte* bytes, std::size_t count) const {
  return read_all(path_, count, [&](std::size_t done) { return ::read(descriptor_, bytes + done, count - done); });
}

FileBytes InputFile::read_range(std::size_t begin, std::size_t end) const {
  MemoryBlock block;
  const std::size_t count = std::max(begin, end) - begin;
  block.reserve_more(count);
  block.truncate(read_at(block.extend(count), count, begin));
  return FileBytes(std::move(block));
}

void InputFile::seek(std::size_t offset) const {
  ::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET);
}

}  // namespace trismooth
