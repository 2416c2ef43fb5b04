// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/bytes/input_file.h"

namespace trismooth {

/// Where the first line begins that begins at `offset`, 1 or more, or behind it: the byte behind an LF or a CR (so CR
/// LF may be cut in two), or the file's end. Reads no more than that line.
std::size_t line_begin_from(const InputFile& file, std::size_t offset);

/// Lines of the text that have anything but white space and a comment, which '#' begins.
std::uint64_t count_lines_with_tokens(std::string_view text, const FileWorkers& workers);

}  // namespace trismooth
