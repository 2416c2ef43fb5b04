// SPDX-License-Identifier: BSD-3-Clause
// Compressed meshes that are damaged, cut off, compressed twice, or say far more than they are long: refused with the
// file's name and the reason, and with memory in proportion to what they say. What is wrong in the text is said as of
// the same file that is not compressed.
#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/bytes/gzip.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "memory_peak.h"
#include "support/accepted_files.h"
#include "support/says.h"
#include "support/scratch_folder.h"

using accepted_files::AcceptedFile;
using trismooth::ReadError;

namespace {

std::string gzipped(std::string_view bytes) {
  trismooth::Workers alone(1);
  std::string packed;
  trismooth::write_gzip(
      bytes, [&packed](std::string_view part) { packed += part; }, trismooth::FileWorkers(alone));
  return packed;
}

/// One of each format that has meshes in one file.
std::vector<AcceptedFile> one_of_each() {
  std::set<trismooth::FileFormat> seen;
  std::vector<AcceptedFile> files;
  for (const AcceptedFile& file : accepted_files::all()) {
    if (is_one_file(file) && seen.insert(format_of(file)).second) {
      files.push_back(file);
    }
  }
  return files;
}

/// Why a file of these bytes is refused, behind its name; "" where it is read.
std::string refusal_of(const ScratchFolder& folder, const std::string& name, std::string_view bytes) {
  const std::string path = folder.write(name, bytes).string();
  const std::string message = message_of<ReadError>([&] { trismooth::read_mesh(path); });
  CAPTURE(name, message);
  if (message.empty()) {
    return message;
  }
  REQUIRE(message.starts_with(path + ":"));
  CHECK(std::ranges::all_of(message, [](char c) { return ' ' <= c && c <= '~'; }));
  return message.substr(path.size());
}

}  // namespace

TEST_CASE("a compressed mesh of any format is refused where gzip's data are cut, damaged or followed by more") {
  const ScratchFolder folder;
  for (const AcceptedFile& file : one_of_each()) {
    const std::string name = "mesh" + file.extension + ".gz";
    const std::string packed = gzipped(file.bytes);
    REQUIRE(refusal_of(folder, name, packed).empty());
    for (std::size_t size = 2; size < packed.size(); size += 1 + packed.size() / 16) {
      CHECK(
          says(refusal_of(folder, name, packed.substr(0, size)), "the gzip data ends too early: the file is cut off"));
    }
    // In front of the last 8 bytes the data, in these a checksum and the number of bytes.
    for (const std::size_t from_end : {std::size_t{2}, std::size_t{6}}) {
      std::string damaged = packed;
      damaged[packed.size() - from_end] = static_cast<char>(damaged[packed.size() - from_end] ^ 1);
      CHECK(says(refusal_of(folder, name, damaged),
                 from_end == 6 ? "damaged (incorrect data check)" : "damaged (incorrect length check)"));
    }
    for (const std::string_view more : {"\n", "more", "\x1f"}) {
      CHECK(says(refusal_of(folder, name, packed + std::string(more)), "bytes follow the end of the gzip data"));
    }
  }
}

TEST_CASE("a mesh that is compressed twice, not at all or that is nothing is refused with what it is") {
  const ScratchFolder folder;
  for (const AcceptedFile& file : one_of_each()) {
    CAPTURE(file.name);
    const std::string name = "mesh" + file.extension + ".gz";
    CHECK(refusal_of(folder, name, gzipped(gzipped(file.bytes))) ==
          ": is compressed (gzip); decompress it first, with 'gzip -dc'");
    const std::string not_compressed =
        ": is not compressed by gzip, as its name says; where it is a mesh as it is, leave out '.gz'";
    CHECK(refusal_of(folder, name, file.bytes) == not_compressed);
    CHECK(refusal_of(folder, name, "") == not_compressed);
    // Of OBJ a file of nothing is one.
    const std::string nothing = refusal_of(folder, name, gzipped(""));
    CHECK(nothing == refusal_of(folder, "mesh" + file.extension, ""));
    CHECK_FALSE(nothing.empty());
  }
}

TEST_CASE("what is wrong in a compressed text is said as of the text itself, with the same places") {
  const ScratchFolder folder;
  std::size_t refused = 0;
  for (const AcceptedFile& file : one_of_each()) {
    CAPTURE(file.name);
    for (std::size_t cut = 0; cut < file.bytes.size(); cut += 1 + file.bytes.size() / 24) {
      std::string damaged = file.bytes.substr(0, cut);
      // Neither a number nor a word of any format.
      damaged += cut % 2 == 0 ? "~" : "";
      const std::string expected = refusal_of(folder, "mesh" + file.extension, damaged);
      CHECK(refusal_of(folder, "mesh" + file.extension + ".gz", gzipped(damaged)) == expected);
      refused += expected.empty() ? 0 : 1;
    }
  }
  CHECK(refused > 100);
}

TEST_CASE("a small file that says very much takes memory in proportion to what it says") {
  constexpr std::size_t size = std::size_t{4} << 20;
  const ScratchFolder folder;
  for (const AcceptedFile& file : one_of_each()) {
    CAPTURE(file.name);
    for (const char filling : {' ', '1', '\n'}) {
      const std::string bomb = gzipped(file.bytes + std::string(size, filling));
      REQUIRE(bomb.size() < size / 500);
      const MemoryPeak peak;
      refusal_of(folder, "mesh" + file.extension + ".gz", bomb);
      // The text, while it grows twice and half of that, and a reader's lists.
      CHECK(peak.bytes() < 6 * size);
    }
  }
}

TEST_CASE("a mesh of two files is not read from compressed ones") {
  const ScratchFolder folder;
  for (const std::string extension : {".node", ".ele"}) {
    folder.write("mesh" + extension, "0 2\n");
    CHECK(says(refusal_of(folder, "mesh" + extension + ".gz", gzipped("0 2\n")), "read as plain files, uncompressed"));
    CHECK(says(refusal_of(folder, "mesh" + extension, gzipped("0 2\n")), "read as plain files, uncompressed"));
  }
}
