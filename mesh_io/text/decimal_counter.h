// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace trismooth {

/// The digits of numbers that count on, as a text has them (see PlainNumbers::next_is): to see that the next number of
/// a list is the one that is expected, nobody has to read it. Of numbers of eight digits at most; others have none.
class DecimalCounter {
 public:
  explicit DecimalCounter(std::int64_t number) {
    if (number < 0 || number > largest) {
      return;
    }
    std::uint64_t digits = 0;
    auto rest = static_cast<std::uint64_t>(number);
    do {
      digits = digits << 8 | (zero + rest % 10);
      rest /= 10;
      ++length_;
    } while (rest > 0);
    digits_ = digits;
    mask_ = mask_of(length_);
  }

  /// Counts on by one.
  void increment() {
    if (length_ == 0) {
      return;
    }
    const std::size_t last = 8 * (length_ - 1);
    digits_ += std::uint64_t{1} << last;
    if ((digits_ >> last & 0xFFU) > nine) {
      carry();
    }
  }

  /// Of the number as text; 0 where it has no digits here.
  std::size_t length() const { return length_; }
  /// Whether the first of eight characters, the first in the lowest byte, are the number's digits.
  bool begins(std::uint64_t characters) const { return (characters & mask_) == digits_; }

 private:
  static constexpr std::int64_t largest = 99'999'999;
  static constexpr std::uint64_t zero = '0';
  static constexpr std::uint64_t nine = '9';

  static std::uint64_t mask_of(std::size_t length) { return ~std::uint64_t{0} >> (64 - 8 * length); }

  /// The last digit has become ten.
  void carry() {
    for (std::size_t digit = length_; digit-- > 0;) {
      const std::size_t at = 8 * digit;
      if ((digits_ >> at & 0xFFU) <= nine) {
        return;
      }
      digits_ -= std::uint64_t{10} << at;
      if (digit > 0) {
        digits_ += std::uint64_t{1} << (at - 8);
      }
    }
    // 99 has become 00: 100.
    if (length_ == 8) {
      *this = DecimalCounter(-1);
      return;
    }
    digits_ = digits_ << 8 | (zero + 1);
    mask_ = mask_of(++length_);
  }

  std::size_t length_ = 0;
  std::uint64_t digits_ = 1;  ///< the first in the lowest byte; nothing begins with what has none
  std::uint64_t mask_ = 0;
};

}  // namespace trismooth
