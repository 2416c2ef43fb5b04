// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/off/off_header.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/text/number_text.h"

namespace trismooth {

namespace {

constexpr std::size_t least_face_numbers = 4;  // the degree, and three vertices

bool is_binary_word(std::string_view token) {
  return same_letters(token, "BINARY");
}

void read_keyword(TextScanner& scanner, OffHeader& header) {
  const std::string_view token = scanner.peek_token();
  if (const std::optional<OffKeyword> keyword = parse_off_keyword(token)) {
    scanner.next_token("the keyword OFF");
    if (!keyword->is_supported()) {
      scanner.fail("unsupported OFF variant " + quoted(keyword->text));
    }
    header.keyword = *keyword;
    // Some files have the first count glued to the keyword.
    scanner.seek(scanner.token_offset() + keyword->text.size());
    header.is_binary = !scanner.at_end_of_line() && is_binary_word(scanner.peek_token());
  } else if (!parse_integer(token)) {
    scanner.next_token("the keyword OFF or the number of vertices");
    scanner.fail("is not an OFF file: expected the keyword OFF or the number of vertices, got " + quoted(token));
  }
}

void read_counts(TextScanner& scanner, std::uint64_t file_bytes, OffHeader& header) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  header.vertex_count = static_cast<std::size_t>(scanner.next_integer("the number of vertices", 0, most));
  const bool on_one_line = !scanner.at_end_of_line();
  header.face_count = static_cast<std::size_t>(scanner.next_integer("the number of faces", 0, most));
  // The number of edges says nothing. Some files leave it out.
  if (!(on_one_line && scanner.at_end_of_line())) {
    scanner.next_integer("the number of edges", 0, std::numeric_limits<std::int64_t>::max());
  }
  if (!scanner.at_end_of_line()) {
    scanner.next_token("the end of the line");
    scanner.fail("expected the end of the line after the counts");
  }
  // Every number takes a digit and a separator, except for the separator at the end of the file.
  const std::size_t numbers_each = 3 + header.keyword.least_extras();
  const std::uint64_t left = file_bytes - scanner.offset();
  require_room(scanner.path(), "vertices", header.vertex_count, 2 * numbers_each, left + 1);
  require_room(scanner.path(), "faces", header.face_count, 2 * least_face_numbers,
               left + 1 - header.vertex_count * 2 * numbers_each);
}

}  // namespace

OffHeader read_off_header(TextScanner& scanner, std::uint64_t file_bytes) {
  OffHeader header;
  read_keyword(scanner, header);
  if (!header.is_binary) {
    read_counts(scanner, file_bytes, header);
  }
  return header;
}

}  // namespace trismooth
