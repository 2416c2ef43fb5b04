// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// Plain text in columns, each as wide as its widest cell. Cells are ASCII.
class TextColumns {
 public:
  enum class Align : bool { left, right };
  struct Column {
    std::size_t gap;  ///< blanks before it
    Align align = Align::right;
  };

  explicit TextColumns(std::vector<Column> columns);

  /// Adds a line below the last; it may have fewer cells than there are columns.
  void add_row(std::vector<std::string> cells);

  /// Titles that stand in one line above the rows, each centred over the columns first .. last.
  struct Title {
    std::size_t first;
    std::size_t last;
    std::string_view text;
  };

  /// The rows, one line each, below a line of the titles if there are any (in ascending order of columns, not longer
  /// than the columns are wide). No line ends in a blank.
  std::string text(const std::vector<Title>& titles = {}) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace trismooth
