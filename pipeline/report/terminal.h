// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <ostream>

namespace trismooth {

/// Columns of what is printed for people: tables, help, wrapped lines.
inline constexpr std::size_t line_columns = 80;

/// A terminal that shows progress, if there is one.
struct Terminal {
  std::ostream* stream = nullptr;  ///< null: none
  /// Its width now; it changes while the program runs.
  std::function<std::size_t()> columns = [] { return line_columns; };
};

/// The width of the terminal that this file descriptor belongs to, or that of printed lines where it cannot be known.
std::size_t terminal_columns(int descriptor);

}  // namespace trismooth
