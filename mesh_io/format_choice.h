// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/file_format.h"

namespace trismooth {

/// What a file is read as.
struct FormatChoice {
  FileFormat format = FileFormat::off;
  std::string note;  ///< one sentence where the file's name says otherwise, else empty
};

/// What the file `path`, whose bytes are `bytes`, is read as. The formats that its extension names come first (`told`
/// where it names none): the one of them that recognises the bytes, or that is the only one named and recognises
/// nothing. Else the only one of all others that recognises the bytes, with a note. Else the first of the extension,
/// whose reader says what is wrong. Throws ReadError where that leaves none.
FormatChoice choose_format(const std::filesystem::path& path, std::string_view bytes, std::optional<FileFormat> told);

}  // namespace trismooth
