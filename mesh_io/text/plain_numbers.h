// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "trismooth/mesh_io/text/decimal_counter.h"
#include "trismooth/mesh_io/text/plain_source.h"

namespace trismooth {

/// What separates numbers: blanks and line ends.
constexpr bool is_white_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Reads numbers that are written as nearly all files write them: digits, a minus sign, a point, an exponent, white
/// space around them. Whatever else a text holds (a plus sign, a comment, a word, a number out of range) it does not
/// judge: the answer is false then, and somebody else has to read that text, and to say what is wrong with it. Inline,
/// since meshes hold millions of numbers. The text must outlive the reader.
class PlainNumbers : public PlainSource {
 public:
  /// Reads from `offset` on.
  PlainNumbers(std::string_view text, std::size_t offset)
      : begin_(text.data()), end_(text.data() + text.size()), at_(text.data() + offset), token_(at_) {}

  /// The next number, across lines; what parse_number() or parse_integer_as() make of it. False where that is not
  /// plain to see; the reader is of no use any more then.
  template <class T>
  [[gnu::always_inline]] bool next(T& value, std::string_view /*what*/ = {}) {  // a call takes as long as the number
    while (at_ != end_ && is_white_space(*at_)) {
      ++at_;
    }
    token_ = at_;
    if constexpr (std::is_floating_point_v<T>) {
      return read(value);
    } else {
      return next_integer(value);
    }
  }

  // As CarefulNumbers have them; false in place of their messages.

  /// The next finite number.
  [[gnu::always_inline]] bool next_real(double& value, std::string_view /*what*/) {
    return next(value) && std::isfinite(value);
  }

  /// The next whole number, from `lowest` to `highest`.
  template <class T>
  [[gnu::always_inline]] bool next_whole(T& value, std::string_view /*what*/,
                                         std::int64_t lowest = std::numeric_limits<T>::min(),
                                         std::int64_t highest = std::numeric_limits<T>::max()) {
    return next(value) && lowest <= value && value <= highest;
  }
  template <class T, class Wrong>
  [[gnu::always_inline]] bool next_index(T& value, std::string_view what, std::int64_t lowest, std::int64_t highest,
                                         const Wrong& /*wrong*/) {
    return next_whole(value, what, lowest, highest);
  }

  /// Passes the next number where it is written as `expected` has it, and nothing otherwise: next() may read it then.
  bool next_is(const DecimalCounter& expected) {
    if constexpr (std::endian::native == std::endian::little) {
      while (at_ != end_ && is_white_space(*at_)) {
        ++at_;
      }
      std::uint64_t characters = 0;
      if (end_ - at_ > static_cast<std::ptrdiff_t>(sizeof(characters))) {
        std::memcpy(&characters, at_, sizeof(characters));
        if (expected.begins(characters) && is_white_space(at_[expected.length()])) {
          token_ = at_;
          at_ += expected.length();
          return true;
        }
      }
    }
    return false;
  }

  /// True where nothing but blanks is left on this line (or in the text); stands behind the blanks then.
  bool at_end_of_line() {
    while (at_ != end_ && is_white_space(*at_) && *at_ != '\n' && *at_ != '\r') {
      ++at_;
    }
    return at_ == end_ || *at_ == '\n' || *at_ == '\r';
  }

  /// Passes `count` tokens, whatever they are; false where there are fewer.
  bool skip(std::size_t count) {
    for (; count > 0; --count) {
      while (at_ != end_ && is_white_space(*at_)) {
        ++at_;
      }
      token_ = at_;
      while (at_ != end_ && !is_white_space(*at_)) {
        ++at_;
      }
    }
    return token_ != end_;
  }

  /// Byte offset of the number that was read last / of what is read next.
  std::size_t token_offset() const { return static_cast<std::size_t>(token_ - begin_); }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }

 private:
  template <class T>
  [[gnu::always_inline]] bool next_integer(T& value) {
    if constexpr (std::endian::native == std::endian::little) {
      std::uint64_t digits = 0;
      if (end_ - at_ > static_cast<std::ptrdiff_t>(sizeof(digits))) {
        // Up to seven digits at once: no branch depends on how many they are.
        std::memcpy(&digits, at_, sizeof(digits));
        digits ^= 0x3030303030303030U;
        const std::uint64_t others = ((digits + 0x7676767676767676U) | digits) & 0x8080808080808080U;
        const int count = std::countr_zero(others) / 8;
        if (count > 0 && count < 8 && is_white_space(at_[count])) {
          digits <<= 64 - 8 * count;
          digits = (digits * 10 + (digits >> 8)) & 0x00FF00FF00FF00FFU;
          digits = (digits * 100 + (digits >> 16)) & 0x0000FFFF0000FFFFU;
          digits = (digits * 10000 + (digits >> 32)) & 0xFFFFFFFFU;
          at_ += count;
          value = static_cast<T>(digits);
          return digits <= static_cast<std::uint64_t>(std::numeric_limits<T>::max());
        }
      }
    }
    return read(value);
  }

  template <class T>
  [[gnu::noinline]] bool read(T& value) {
    const auto [stop, error] = std::from_chars(at_, end_, value);
    at_ = stop;
    return error == std::errc() && (stop == end_ || is_white_space(*stop));
  }

  const char* begin_;
  const char* end_;
  const char* at_;
  const char* token_;
};

}  // namespace trismooth
