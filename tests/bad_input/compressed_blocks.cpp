// SPDX-License-Identifier: BSD-3-Clause
// Compressed arrays: the lowest and highest bit of every byte of every block and block header flipped, and headers that
// lie. zlib and LZMA carry checksums, so what is accepted is the same mesh; LZ4 carries none, so numbers may differ,
// but never how many.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "catch.h"
#include "input_checks.h"
#include "support/accepted_files.h"
#include "support/accepted_vtk_files.h"

using accepted_files::AcceptedFile;
using accepted_files::vtk::number_bytes;
using trismooth::MeshDocument;

namespace {

std::vector<AcceptedFile> compressed_files() {
  std::vector<AcceptedFile> files;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (contains(file.name, "appended_raw") && contains(file.bytes, "compressor=")) {
      files.push_back(file);
    }
  }
  return files;
}

/// Where the appended bytes begin and end.
std::array<std::size_t, 2> appended_range(const AcceptedFile& file) {
  return {file.bytes.find('_', file.bytes.find("<AppendedData")) + 1, file.bytes.rfind("\n</AppendedData")};
}

/// The file with a word of block headers in place of the bytes at `at`.
std::string with_word(const AcceptedFile& file, std::size_t at, std::uint64_t word) {
  const bool big_endian = contains(file.bytes, "BigEndian");
  const std::string stored = contains(file.bytes, "header_type=\"UInt64\"")
                                 ? number_bytes(word, big_endian)
                                 : number_bytes(static_cast<std::uint32_t>(word), big_endian);
  return std::string(file.bytes).replace(at, stored.size(), stored);
}

/// Offsets in the file of the arrays in the appended bytes.
std::vector<std::size_t> array_begins(const AcceptedFile& file) {
  std::vector<std::size_t> begins;
  constexpr std::string_view attribute = "offset=\"";
  for (std::size_t at = file.bytes.find(attribute); at != std::string::npos; at = file.bytes.find(attribute, at + 1)) {
    begins.push_back(appended_range(file)[0] + std::stoull(file.bytes.substr(at + attribute.size())));
  }
  return begins;
}

std::string other_mesh(const Outcome& outcome, const MeshDocument& whole, bool checked) {
  if (!outcome.document || difference(whole, *outcome.document).empty()) {
    return {};
  }
  const bool same_shape = outcome.document->points.size() == whole.points.size() &&
                          outcome.document->cells.offsets.size() == whole.cells.offsets.size();
  return checked || !same_shape ? "is accepted with other data" : "";
}

}  // namespace

TEST_CASE("A bit that is flipped in compressed data is found wherever the compressor has a checksum") {
  Faults faults;
  std::array<std::size_t, 2> accepted_and_all{};
  for (const AcceptedFile& file : compressed_files()) {
    const MeshDocument whole = read(file).document.value();
    const bool checked = contains(file.name, "zlib") || contains(file.name, "lzma");
    const auto [begin, end] = appended_range(file);
    for (std::size_t at = begin; at < end; at += stride_of(file)) {
      for (const int bit : {0x01, 0x80}) {
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ bit);
        const Outcome outcome = read(file, bytes);
        const std::string place = fmt::format("bit {:#x} of byte {}", bit, at);
        faults.add_any(file.name, place, outcome.fault);
        faults.add_any(file.name, place, other_mesh(outcome, whole, checked));
        accepted_and_all[0] += checked && outcome.document ? 1 : 0;
        ++accepted_and_all[1];
      }
    }
  }
  // Some bits mean nothing: the size of all blocks but the last, where there is one block.
  CHECK(accepted_and_all[0] < accepted_and_all[1] / 10);
  REQUIRE_NONE(faults);
}

TEST_CASE("A block header that lies is refused before memory is taken") {
  Faults faults;
  for (const AcceptedFile& file : compressed_files()) {
    const MeshDocument whole = read(file).document.value();
    const std::size_t word_size = contains(file.bytes, "header_type=\"UInt64\"") ? 8 : 4;
    for (const std::size_t array : array_begins(file)) {
      // Number of blocks, their size, the size of the last, and the compressed size of the first.
      for (std::size_t word = 0; word < 4; ++word) {
        for (const std::uint64_t lie : std::initializer_list<std::uint64_t>{
                 0, 1, 2, 3, 95, 97, 1U << 16, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, std::uint64_t{1} << 32,
                 (std::uint64_t{1} << 32) + 96, std::uint64_t{1} << 58, std::uint64_t{1} << 61,
                 std::numeric_limits<std::int64_t>::max(), std::uint64_t{1} << 63,
                 std::numeric_limits<std::uint64_t>::max()}) {
          const std::size_t at = array + word * word_size;
          if (at + word_size > file.bytes.size()) {
            continue;
          }
          const Outcome outcome = read(file, with_word(file, at, lie));
          const std::string place = fmt::format("word {} at byte {} is {}", word, at, lie);
          faults.add_any(file.name, place, outcome.fault);
          faults.add_any(file.name, place, other_mesh(outcome, whole, true));
        }
      }
    }
  }
  REQUIRE_NONE(faults);
}

TEST_CASE("A small file that claims gigabytes is refused before memory is taken") {
  Faults faults;
  for (const AcceptedFile& file : compressed_files()) {
    for (const std::size_t array : array_begins(file)) {
      const std::size_t word_size = contains(file.bytes, "header_type=\"UInt64\"") ? 8 : 4;
      // One block of 1 GiB, and all counts of the file raised to match.
      std::string bytes = with_word(file, array, 1);
      bytes = with_word({file.name, file.extension, bytes}, array + word_size, 1U << 30);
      bytes = with_word({file.name, file.extension, bytes}, array + 2 * word_size, 0);
      for (const std::string_view count :
           {"NumberOfPoints=\"", "NumberOfCells=\"", "NumberOfPolys=\"", "NumberOfTuples=\""}) {
        for (const std::string_view many : {"44739242", "134217728", "268435456", "1073741824"}) {
          std::string claim = bytes;
          const std::size_t at = claim.find(count);
          if (at == std::string::npos) {
            continue;
          }
          const std::size_t begin = at + count.size();
          claim.replace(begin, claim.find('"', begin) - begin, many);
          const Outcome outcome = read(file, claim);
          faults.add_any(file.name, fmt::format("{}{}", count, many), outcome.fault);
          if (outcome.document) {
            faults.add(file.name, fmt::format("{}{}", count, many), "is accepted");
          }
        }
      }
    }
  }
  REQUIRE_NONE(faults);
}
