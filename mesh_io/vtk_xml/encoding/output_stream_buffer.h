// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <streambuf>
#include <vector>

namespace trismooth {

/// Writes a plain file for libraries that print to a std::ostream and do not bear it well when that fails (VTK's XML
/// writers may crash): to them, everything succeeds. close() tells what did not. They may go back and forth.
class OutputStreamBuffer final : public std::streambuf {
 public:
  /// Makes the file, or empties it. Throws WriteError.
  explicit OutputStreamBuffer(std::filesystem::path path);
  OutputStreamBuffer(const OutputStreamBuffer&) = delete;
  OutputStreamBuffer& operator=(const OutputStreamBuffer&) = delete;
  ~OutputStreamBuffer() override;

  /// Writes what is left. Throws WriteError with the first error since the start. Without it errors go unseen.
  void close();

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* characters, std::streamsize count) override;
  pos_type seekoff(off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode which) override;
  pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

 private:
  off_type position() const { return block_start_ + (pptr() - pbase()); }
  void write_block();
  void write_out(const char* from, std::size_t count);

  std::filesystem::path path_;
  std::vector<char> block_;
  int descriptor_;
  int error_ = 0;
  off_type block_start_ = 0;  ///< where in the file the block goes
  off_type size_ = 0;         ///< of the file, without the block
};

}  // namespace trismooth
