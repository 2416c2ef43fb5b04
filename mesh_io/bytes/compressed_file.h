// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trismooth {

/// How a file is compressed as a whole, which no reader here undoes.
struct Compression {
  std::string_view name;       ///< "gzip"
  std::string_view extension;  ///< ".gz"
  std::string_view magic;      ///< the bytes that such files begin with
  std::string_view command;    ///< what writes the file uncompressed to its standard output
};

/// The compression that the bytes begin as, or nothing.
std::optional<Compression> compression_of(std::string_view bytes);

/// The compression that the path's extension names (any case), or nothing.
std::optional<Compression> compression_named(const std::filesystem::path& path);

/// "is compressed (gzip); decompress it first, with 'gzip -dc'", for messages.
std::string describe(const Compression& compression);

}  // namespace trismooth
