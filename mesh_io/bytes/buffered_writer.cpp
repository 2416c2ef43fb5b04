#include "trismooth/mesh_io/bytes/buffered_writer.h"

#include <cerrno>
#include <cstring>

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
    : path_(path), block_(make_block()), file_(std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) {
    fail();
  }
  // The C library heeds the size only with a buffer of ours.
  std::setvbuf(file_, reinterpret_cast<char*>(block_.data()), _IOFBF, block_.size());
}

BufferedWriter::~BufferedWriter() {
  if (file_ != nullptr) {
    std::fclose(file_);
  }
}

void BufferedWriter::write(std::string_view bytes) {
  // fwrite takes no null pointer, not even for no bytes.
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    fail();
  }
}

void BufferedWriter::close() {
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) {
    fail();
  }
}

void BufferedWriter::fail() const {
  throw WriteError(path_, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace trismooth
