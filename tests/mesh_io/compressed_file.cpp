// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/compressed_file.h"

#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::ReadError;
using trismooth::WriteError;

namespace {

struct CompressedFile {
  std::string name;
  std::string extension;
  std::string bytes;  ///< the first that the program of that name writes
};

std::vector<CompressedFile> compressed_files() {
  return {{"bzip2", ".bz2", "BZh91AY&SY\x8e"},
          {"xz", ".xz",
           std::string("\xfd"
                       "7zXZ\x00\x00\x04",
                       8)},
          {"zstd", ".zst", std::string("\x28\xb5\x2f\xfd\x04\x58", 6)},
          {"zip", ".zip", std::string("PK\x03\x04\x14\x00", 6)},
          {"7z", ".7z", std::string("7z\xbc\xaf\x27\x1c\x00\x04", 8)}};
}

}  // namespace

TEST_CASE("a compressed file is called that, by its name or by its first bytes") {
  const ScratchFolder folder;
  for (const auto& [name, extension, bytes] : compressed_files()) {
    CAPTURE(name);
    for (const std::string& file : {"mesh.vtu" + extension, "mesh.off" + extension, std::string("mesh.vtu"),
                                    std::string("mesh.off"), std::string("mesh.stl"), std::string("mesh.obj")}) {
      CAPTURE(file);
      const auto path = folder.write(file, bytes + std::string(200, 'x'));
      const std::string message = message_of<ReadError>([&] { trismooth::read_mesh(path); });
      CHECK(message.find(file + ": is compressed (" + name + "); decompress it first") != std::string::npos);
    }
    const std::string output = "out.vtu" + extension;
    const std::string message = message_of<WriteError>([&] { trismooth::output_format(output); });
    CHECK(message.find("out.vtu" + extension + ": nothing is written compressed but by gzip (.gz); leave out '" +
                       extension + "'") == 0);
  }
}

TEST_CASE("files that only begin in a similar way are not taken for compressed ones") {
  for (const std::string bytes : {"", "B", "BZh", "BZh9", "BZh91AY&S", "PK", "7z", "\x1f\x8b", "OFF\n3 1 0\n"}) {
    CAPTURE(bytes);
    CHECK(!trismooth::compression_of(bytes));
  }
  CHECK(!trismooth::compression_named("mesh.off"));
  CHECK(!trismooth::compression_named("gz"));
  CHECK(trismooth::compression_named("MESH.OFF.GZ"));
}
