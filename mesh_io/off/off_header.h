// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "trismooth/mesh_io/off/off_keyword.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

/// What an OFF file says before its vertices.
struct OffHeader {
  OffKeyword keyword;  ///< a view of the text that was scanned
  bool is_binary = false;
  std::size_t vertex_count = 0;  ///< of text
  std::size_t face_count = 0;    ///< likewise
};

/// Reads it from the start of a file of `file_bytes` bytes; the scanner has its first bytes, or all. Of text it is at
/// the end of the line of the counts then, of a binary file before the word BINARY. Throws ReadError.
OffHeader read_off_header(TextScanner& scanner, std::uint64_t file_bytes);

}  // namespace trismooth
