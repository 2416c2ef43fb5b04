// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/nastran/nastran_line.h"

namespace trismooth {

/// An entry of bulk data: a line that names it, and those on which it goes on.
struct NastranCard {
  std::string name;                ///< in upper case, without the star of large fields
  std::vector<NastranLine> lines;  ///< without empty ones and comments between them

  /// The field of that number, from 0 behind the name, over all lines, without blanks around it; empty where it is
  /// blank or not there. A pair of lines in large field counts as a line.
  std::string_view field(std::size_t i) const;
  /// Fields up to the last that may be there.
  std::size_t field_count() const { return most_nastran_fields * rows_.size(); }

  /// Makes it the card of that line alone.
  void start(const NastranLine& line);
  void add(const NastranLine& line);

 private:
  /// The lines that have fields 8 i to 8 i + 7: one, or two of large fields.
  struct Row {
    std::size_t first = 0;
    bool has_two = false;
  };
  std::vector<Row> rows_;
};

/// Goes over the lines of a text. LF, CR LF and CR end a line.
class NastranLines {
 public:
  /// From `begin` on. The text must outlive it.
  NastranLines(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

  /// Goes to the next line; false behind the last.
  bool next();
  /// The line, without its end.
  std::string_view line() const { return line_; }
  /// Where the next one begins.
  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }

 private:
  std::string_view text_;
  std::size_t at_;
  std::string_view line_;
};

/// Reads the card whose first line begins at `begin` to `card`, with all lines on which it goes on; where the first
/// line that is no part of it begins.
std::size_t read_nastran_card(std::string_view text, std::size_t begin, NastranCard& card);

}  // namespace trismooth
