// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// What plain numbers have beside their numbers (see PlainNumbers, BinaryNumbers). What a row or a section means is
/// written once, as a function of numbers that are plain or careful: both have next(value, what), at_end_of_line() and
/// token_offset(), and fail(message) for what breaks the format's rules. Plain ones answer false where a number is not
/// plain to see or is refused, and say nothing: the section is read again then, with careful ones, whose next() takes
/// all that the format allows, and which throw ReadError, at the number that was read last, with what was expected or
/// with message(the number as it is written). A function that gets false answers false.
struct PlainSource {
  static constexpr bool is_plain = true;

  template <class Message>
  static bool fail(const Message& /*message*/) {
    return false;
  }
  template <class Message>
  static bool fail_at_next(std::string_view /*what*/, const Message& /*message*/) {
    return false;
  }
};

}  // namespace trismooth
