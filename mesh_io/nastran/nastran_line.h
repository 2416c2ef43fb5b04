// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace trismooth {

/// Fields of a line behind the first: 8 of 8 columns (small field), or 4 of 16 (large field). Free field, in which
/// commas divide them, has either.
inline constexpr std::size_t most_nastran_fields = 8;

/// Columns of the first field, which names the card.
inline constexpr std::size_t nastran_head_columns = 8;

/// A line of bulk data, divided into its fields. A tab goes on to the next column that is a multiple of 8. All views
/// are of the line's text.
struct NastranLine {
  std::string_view text;  ///< without its end
  std::string_view head;  ///< the first field, as it stands there
  /// As they stand there, with blanks; where the line ends before one, an empty view of the place where it ends.
  std::array<std::string_view, most_nastran_fields> fields;
  std::size_t count = most_nastran_fields;  ///< fields of such a line
  std::size_t present = 0;                  ///< those that begin before the line ends
  bool is_free = false;
  bool last_is_short = false;  ///< in columns: the last that is present ends with the line, not with its columns
  std::string_view tail;       ///< what follows the last field: the mark of a continuation, a comment

  bool is_large() const { return count < most_nastran_fields; }
  /// Columns of a field.
  std::size_t width() const { return is_large() ? 16 : 8; }
  /// Whether the line goes on with the card of the line before it.
  bool is_continuation() const;
  /// What the first field names, in upper case without the star of large fields.
  std::string name() const;
  /// Behind the fields, what names the line that goes on, or the end of the first field of that: "+A1", "*", "".
  std::string_view mark() const;
};

/// Divides a line, which ends before its line end. What stands behind a dollar sign is a comment.
NastranLine divide_nastran_line(std::string_view text);

/// Whether nothing is in the line but blanks and a comment.
bool is_empty_nastran_line(std::string_view text);

/// In upper case.
std::string nastran_key(std::string_view text);

/// Whether the line begins with that word (in upper case), in any case of its letters, and with nothing that would make
/// it a longer one.
bool begins_with_nastran_word(std::string_view line, std::string_view word);

}  // namespace trismooth
