// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace trismooth {

/// Passes on to another stream what is written to it as printable_lines() shows it. All that the command line says goes
/// through one, so that no name in a file and no path can steer the terminal, whoever prints it.
class PrintableStream : public std::ostream {
 public:
  /// `target` must outlive it. A failure of it is a failure of this stream.
  explicit PrintableStream(std::ostream& target);

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::ostream& target) : target_(target) {}
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() override;

   protected:
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int sync() override;

   private:
    bool pass_on(std::string_view text);

    std::ostream& target_;
    std::string begun_;  ///< the first bytes of a character whose rest is not written yet
  };

  Buffer buffer_;
};

}  // namespace trismooth
