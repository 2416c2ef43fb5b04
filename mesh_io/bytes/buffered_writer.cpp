// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/buffered_writer.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "trismooth/mesh_io/bytes/broken_pipe.h"
#include "trismooth/mesh_io/errors.h"

namespace trismooth {

namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;

/// Not filled with zeros: that would touch all of it for the smallest file.
MemoryBlock make_block() {
  MemoryBlock block;
  block.extend(block_bytes);
  return block;
}

}  // namespace

BufferedWriter::BufferedWriter(const std::filesystem::path& path)
    : path_(path),
      block_(make_block()),
      descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) {
    fail();
  }
}

BufferedWriter::~BufferedWriter() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void BufferedWriter::write(std::string_view bytes) {
  constexpr std::size_t not_worth_a_call = block_bytes / 16;
  if (bytes.size() >= not_worth_a_call) {
    flush();
    write_out(bytes);
    return;
  }
  if (bytes.size() > block_.size() - used_) {
    flush();
  }
  if (!bytes.empty()) {
    std::memcpy(block_.data() + used_, bytes.data(), bytes.size());
    used_ += bytes.size();
  }
}

void BufferedWriter::flush() {
  write_out({reinterpret_cast<const char*>(block_.data()), std::exchange(used_, 0)});
}

void BufferedWriter::write_out(std::string_view bytes) {
  if (!write_to_descriptor(descriptor_, bytes)) {
    fail();
  }
}

void BufferedWriter::close() {
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) {
    fail();
  }
}

void BufferedWriter::fail() const {
  throw WriteError(path_, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace trismooth
