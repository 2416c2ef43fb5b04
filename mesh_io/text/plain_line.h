// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "trismooth/mesh_io/text/plain_numbers.h"

namespace trismooth {

/// The next number, which is on the line that is being read.
template <class T>
bool next_on_line(PlainNumbers& numbers, T& value) {
  return !numbers.at_end_of_line() && numbers.next(value);
}

/// How many numbers there are up to the end of the line; nothing where they are more than `most`, or where there is
/// something else.
inline std::optional<std::size_t> count_rest_of_line(PlainNumbers& numbers, std::size_t most) {
  std::size_t count = 0;
  for (double value = 0; !numbers.at_end_of_line(); ++count) {
    if (count == most || !numbers.next(value)) {
      return std::nullopt;
    }
  }
  return count;
}

/// Passes so many numbers that can be read as a T; true where the line ends behind them.
template <class T>
bool skip_rest_of_line(PlainNumbers& numbers, std::size_t count) {
  for (T value{}; count > 0; --count) {
    if (!next_on_line(numbers, value)) {
      return false;
    }
  }
  return numbers.at_end_of_line();
}

}  // namespace trismooth
