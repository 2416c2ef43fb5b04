// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/compressed_file.h"

#include <algorithm>
#include <array>

#include "trismooth/base/text/letter_case.h"

namespace trismooth {

namespace {

using namespace std::string_view_literals;

constexpr std::array<Compression, 6> compressions{{
    {"gzip", ".gz", "\x1f\x8b\x08"sv, "gzip -dc"},
    {"bzip2", ".bz2", "BZh"sv, "bzip2 -dc"},
    {"xz", ".xz",
     "\xfd"
     "7zXZ\0"sv,
     "xz -dc"},
    {"zstd", ".zst", "\x28\xb5\x2f\xfd"sv, "zstd -dc"},
    {"zip", ".zip", "PK\x03\x04"sv, "unzip -p"},
    {"7z", ".7z", "7z\xbc\xaf\x27\x1c"sv, "7z x -so"},
}};

/// Of bzip2 the first bytes are letters; a digit and the first bytes of a block follow.
bool begins_as_bzip2(std::string_view bytes) {
  constexpr std::string_view block = "1AY&SY";
  return bytes.size() > 3 && '1' <= bytes[3] && bytes[3] <= '9' && bytes.substr(4).starts_with(block);
}

}  // namespace

std::optional<Compression> compression_of(std::string_view bytes) {
  for (const Compression& compression : compressions) {
    if (bytes.starts_with(compression.magic) && (compression.name != "bzip2" || begins_as_bzip2(bytes))) {
      return compression;
    }
  }
  return std::nullopt;
}

std::optional<Compression> compression_named(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const auto* const found = std::ranges::find(compressions, extension, &Compression::extension);
  return found == compressions.end() ? std::nullopt : std::optional(*found);
}

std::string describe(const Compression& compression) {
  return "is compressed (" + std::string(compression.name) + "); decompress it first, with '" +
         std::string(compression.command) + "'";
}

}  // namespace trismooth
