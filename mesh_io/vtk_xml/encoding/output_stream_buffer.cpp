// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/output_stream_buffer.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

constexpr std::size_t stream_block_bytes = std::size_t{1} << 18;

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw WriteError(path, std::string("cannot be written: ") + std::strerror(error));
}

}  // namespace

OutputStreamBuffer::OutputStreamBuffer(std::filesystem::path path)
    : path_(std::move(path)),
      block_(stream_block_bytes),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) {
    fail(path_, errno);
  }
  setp(block_.data(), block_.data() + block_.size());
}

OutputStreamBuffer::~OutputStreamBuffer() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void OutputStreamBuffer::close() {
  write_block();
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) {
    error_ = errno;
  }
  if (error_ != 0) {
    fail(path_, error_);
  }
}

OutputStreamBuffer::int_type OutputStreamBuffer::overflow(int_type character) {
  write_block();
  return traits_type::eq_int_type(character, traits_type::eof()) ? traits_type::not_eof(character)
                                                                 : sputc(traits_type::to_char_type(character));
}

OutputStreamBuffer::pos_type OutputStreamBuffer::seekoff(off_type offset, std::ios_base::seekdir direction,
                                                         std::ios_base::openmode which) {
  if (direction == std::ios_base::cur && offset == 0) {
    return position();
  }
  const off_type end = std::max(size_, position());
  const off_type base = direction == std::ios_base::beg ? 0 : direction == std::ios_base::cur ? position() : end;
  return seekpos(base + offset, which);
}

OutputStreamBuffer::pos_type OutputStreamBuffer::seekpos(pos_type position, std::ios_base::openmode /*which*/) {
  if (off_type(position) < 0) {
    return off_type(-1);
  }
  write_block();
  block_start_ = position;
  return position;
}

std::streamsize OutputStreamBuffer::xsputn(const char* characters, std::streamsize count) {
  if (count < static_cast<std::streamsize>(block_.size())) {
    return std::streambuf::xsputn(characters, count);
  }
  write_block();
  write_out(characters, static_cast<std::size_t>(count));
  return count;
}

void OutputStreamBuffer::write_block() {
  write_out(pbase(), static_cast<std::size_t>(pptr() - pbase()));
  setp(block_.data(), block_.data() + block_.size());
}

/// Writes where the block goes, and moves that place on.
void OutputStreamBuffer::write_out(const char* from, std::size_t count) {
  const off_type end = block_start_ + static_cast<off_type>(count);
  while (error_ == 0 && block_start_ != end) {
    const ssize_t written = ::pwrite(descriptor_, from, static_cast<std::size_t>(end - block_start_), block_start_);
    if (written >= 0) {
      from += written;
      block_start_ += written;
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
  block_start_ = end;
  size_ = std::max(size_, block_start_);
}

}  // namespace trismooth
