// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/gzip.h"

#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/accepted_files.h"
#include "support/dice.h"
#include "support/says.h"
#include "support/scratch_folder.h"

using trismooth::FileWorkers;
using trismooth::MemoryBlock;
using trismooth::MeshDocument;
using trismooth::ReadError;
using trismooth::Workers;

namespace {

std::string compressed(std::string_view bytes, int threads = 1) {
  Workers workers(threads);
  std::string result;
  trismooth::write_gzip(
      bytes, [&result](std::string_view part) { result += part; }, FileWorkers(workers));
  return result;
}

std::string decompressed(std::string_view bytes) {
  const MemoryBlock block = trismooth::gunzip("mesh.off.gz", bytes);
  return {reinterpret_cast<const char*>(block.data()), block.size()};
}

std::string refusal(const std::string& bytes) {
  return message_of<ReadError>([&] { decompressed(bytes); });
}

/// Text as meshes have it, of about that size.
std::string numbers(std::size_t size) {
  std::string text;
  for (std::uint64_t i = 0; text.size() < size; ++i) {
    text += std::to_string(i * i * 2654435761U % 1000003) + (i % 3 == 2 ? "\n" : " ");
  }
  return text;
}

/// What `gzip --no-name` of GNU makes of "OFF\n".
const std::string by_gnu(
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xf3\x77\x73\xe3\x02\x00\x98\x67\xd2\xd0\x04\x00\x00\x00", 24);

}  // namespace

TEST_CASE("what is compressed is decompressed to the same bytes, whatever their number") {
  const std::size_t block = std::size_t{1} << 18;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, block - 1, block, block + 1,
                                 3 * block, (std::size_t{1} << 20) + 7}) {
    CAPTURE(size);
    const std::string text = numbers(size).substr(0, size);
    const std::string packed = compressed(text);
    CHECK(trismooth::is_gzip(packed));
    CHECK(decompressed(packed) == text);
    CHECK(decompressed(compressed(std::string(size, 'x'))) == std::string(size, 'x'));
  }
}

TEST_CASE("compressed is the same for every number of threads and at every time") {
  const std::string text = numbers(3'000'000);
  const std::string alone = compressed(text);
  CHECK(compressed(text, 2) == alone);
  CHECK(compressed(text, 5) == alone);
  CHECK(alone.size() < text.size() / 2);
  // No name and no time in the header.
  CHECK(alone.substr(0, 10) == std::string("\x1f\x8b\x08\0\0\0\0\0\0\xff", 10));
}

TEST_CASE("members are read one behind the other") {
  CHECK(decompressed(compressed("OFF\n") + compressed("") + compressed("3 1 0\n")) == "OFF\n3 1 0\n");
}

TEST_CASE("files of which a part is missing are refused at every length") {
  const std::string whole = compressed(numbers(2000));
  for (std::size_t size = 2; size < whole.size(); ++size) {
    CAPTURE(size);
    const std::string message = refusal(whole.substr(0, size));
    CHECK(says(message, "mesh.off.gz: compressed byte " + std::to_string(size) +
                            ": the gzip data ends too early: the file is cut off"));
  }
}

TEST_CASE("every byte that is changed is noticed, but those that say nothing") {
  const std::string text = numbers(2000);
  const std::string whole = compressed(text);
  for (std::size_t i = 2; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    CAPTURE(i);
    const bool says_nothing = 4 <= i && i < 10;  // time, level, system
    std::string got;
    const std::string message = message_of<ReadError>([&] { got = decompressed(changed); });
    if (says_nothing) {
      CHECK(got == text);
    } else {
      CHECK(says(message, "mesh.off.gz: compressed byte "));
    }
  }
  CHECK(says(refusal(whole.substr(0, 2) + "\x07" + whole.substr(3)), "damaged (unknown compression method)"));
}

TEST_CASE("bytes behind the end are refused") {
  const std::string whole = compressed("OFF\n");
  for (const std::string& more :
       {std::string("\0", 1), std::string("\n"), std::string(500, '\0'), std::string("\x1f")}) {
    CHECK(says(refusal(whole + more),
               "compressed byte " + std::to_string(whole.size()) + ": bytes follow the end of the gzip data"));
  }
}

TEST_CASE("compressed meshes are read as they are, and written back to the same bytes, compressed") {
  const ScratchFolder folder;
  for (const accepted_files::AcceptedFile& file : accepted_files::all()) {
    if (!is_one_file(file)) {
      continue;
    }
    CAPTURE(file.name);
    const auto plain_path = folder.write("mesh" + file.extension, file.bytes);
    const auto path = folder.write("mesh" + file.extension + ".gz", compressed(file.bytes));
    const MeshDocument plain = trismooth::read_mesh(plain_path);
    const MeshDocument document = trismooth::read_mesh(path);
    CHECK(document.format == plain.format);
    CHECK(document.points == plain.points);
    CHECK(document.cells.connectivity == plain.cells.connectivity);
    CHECK(document.notes == plain.notes);
    const auto written = folder / ("out" + file.extension + ".GZ");
    const auto written_plain = folder / ("out" + file.extension);
    trismooth::write_mesh(written, document);
    trismooth::write_mesh(written_plain, plain);
    CHECK(decompressed(bytes_of(written)) == bytes_of(written_plain));
    // A name without the .gz, too, and what is told of that.
    const MeshDocument unnamed = trismooth::read_mesh(folder.write("mesh" + file.extension, compressed(file.bytes)));
    CHECK(unnamed.points == plain.points);
    REQUIRE_FALSE(unnamed.notes.empty());
    CHECK(unnamed.notes[plain.notes.size()] == "the file is compressed by gzip, which its name does not say");
  }
}

TEST_CASE("damage in a compressed file is told with its name, and the place in the text where that is wrong") {
  const ScratchFolder folder;
  const auto cut = folder.write("cut.off.gz", compressed(numbers(1000)).substr(0, 100));
  CHECK(says(message_of<ReadError>([&] { trismooth::read_mesh(cut); }),
             "cut.off.gz: compressed byte 100: the gzip data ends too early"));
  const auto wrong = folder.write("wrong.off.gz", compressed("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n"));
  CHECK(says(message_of<ReadError>([&] { trismooth::read_mesh(wrong); }), "wrong.off.gz:4: "));
  const auto plain = folder.write("plain.off.gz", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK(says(message_of<ReadError>([&] { trismooth::read_mesh(plain); }),
             "plain.off.gz: is not compressed by gzip, as its name says"));
  const auto twice = folder.write("twice.off.gz", compressed(compressed("OFF\n")));
  CHECK(says(message_of<ReadError>([&] { trismooth::read_mesh(twice); }), "is compressed (gzip); decompress it first"));
}

TEST_CASE("what other programs compress is read") {
  CHECK(decompressed(by_gnu) == "OFF\n");
}
