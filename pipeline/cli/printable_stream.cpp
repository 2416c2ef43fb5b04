// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/cli/printable_stream.h"

#include <algorithm>
#include <string_view>

#include "trismooth/base/text/printable_text.h"
#include "trismooth/base/text/utf8.h"

namespace trismooth {

namespace {

/// How many bytes at the end of `text` may become a character together with what follows.
std::size_t begun_bytes(std::string_view text) {
  constexpr std::size_t longest = 3;
  for (std::size_t count = std::min(longest, text.size()); count > 0; --count) {
    if (is_begun_utf8_character(text.substr(text.size() - count))) {
      return count;
    }
  }
  return 0;
}

}  // namespace

PrintableStream::PrintableStream(std::ostream& target) : std::ostream(nullptr), buffer_(target) {
  rdbuf(&buffer_);
}

PrintableStream::Buffer::~Buffer() {
  pass_on(begun_);
}

bool PrintableStream::Buffer::pass_on(std::string_view text) {
  if (!text.empty()) {
    target_ << printable_lines(text);
  }
  return target_.good();
}

PrintableStream::Buffer::int_type PrintableStream::Buffer::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) {
    return traits_type::not_eof(character);
  }
  const char byte = traits_type::to_char_type(character);
  return xsputn(&byte, 1) == 1 ? character : traits_type::eof();
}

std::streamsize PrintableStream::Buffer::xsputn(const char* text, std::streamsize count) {
  begun_.append(text, static_cast<std::size_t>(count));
  const std::size_t kept = begun_bytes(begun_);
  const bool passed = pass_on(std::string_view(begun_).substr(0, begun_.size() - kept));
  begun_.erase(0, begun_.size() - kept);
  return passed ? count : 0;
}

int PrintableStream::Buffer::sync() {
  const bool passed = pass_on(begun_);
  begun_.clear();
  target_.flush();
  return passed && target_.good() ? 0 : -1;
}

}  // namespace trismooth
