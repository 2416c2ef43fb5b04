// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trismooth {

/// A parameter of a keyword line.
struct InpParameter {
  std::string name;        ///< in upper case, without blanks
  std::string_view value;  ///< as it stands there, without blanks around it; empty where there is none
  std::size_t begin = 0;   ///< where the comma before it stands
  std::size_t end = 0;     ///< behind its last character
};

/// A keyword line, with the lines on which it goes on.
struct InpKeyword {
  std::string name;  ///< in upper case, without the star and blanks: "SOLIDSECTION"
  std::vector<InpParameter> parameters;
  std::size_t begin = 0;  ///< where the star stands
  std::size_t end = 0;    ///< where its last line ends

  /// The parameter of that name, or nullptr.
  const InpParameter* find(std::string_view parameter) const;
  /// The value of the parameter of that name; empty where there is none.
  std::string_view value_of(std::string_view parameter) const;
};

/// Goes over the lines of an input file of Abaqus; passes comments (**) and blank lines. LF, CR LF and CR end a line.
class InpLines {
 public:
  enum class Kind : std::uint8_t { keyword, data, end };

  /// The text must outlive it.
  explicit InpLines(std::string_view text);

  /// Goes to the next line and says what it is.
  Kind next();

  /// Of a data line: its text without blanks around it, and where that stands.
  std::string_view line() const { return line_; }
  std::size_t offset() const { return static_cast<std::size_t>(line_.data() - text_.data()); }

  /// Of a keyword line. Goes to the last of its lines: one that ends with a comma goes on, unless numbers follow.
  InpKeyword keyword();

 private:
  std::string_view raw_line();
  bool next_line();

  std::string_view text_;
  std::size_t at_;
  std::string_view line_;
};

/// Goes over the fields of a data line: what stands between commas. A comma at the end has an empty field behind it.
class InpFields {
 public:
  explicit InpFields(std::string_view line) : rest_(line) {}

  /// Goes to the next field; false behind the last.
  bool next();
  /// The field without blanks around it; where it is empty, an empty view of its place.
  std::string_view text() const { return field_; }

 private:
  std::string_view rest_;
  std::string_view field_;
  bool is_last_ = false;
};

/// Whether a data line goes on in the next one.
inline bool inp_goes_on(std::string_view line) {
  return line.ends_with(',');
}

/// A label as people wrote it: without quotation marks, or else without blanks.
std::string inp_label(std::string_view text);

/// A label as labels are compared: inp_label() in upper case, but for those in quotation marks.
std::string inp_key(std::string_view text);

/// Throws ReadError at the line of the byte at `offset`.
[[noreturn]] void fail_in_inp(const std::filesystem::path& path, std::string_view text, std::size_t offset,
                              const std::string& message);

}  // namespace trismooth
