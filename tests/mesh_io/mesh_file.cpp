// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/mesh_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <sys/stat.h>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/cells/empty_groups.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/says.h"
#include "support/scratch_folder.h"

using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ReadError;
using trismooth::write_mesh;
using trismooth::WriteError;

namespace fs = std::filesystem;

namespace {

constexpr const char* triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// An original that fails when half of it is written.
class FailingOriginal : public trismooth::OriginalFile {
 public:
  void write(const fs::path& path, const MeshDocument&, std::span<const trismooth::DataArray>,
             std::span<const trismooth::DataArray>, trismooth::Workers&) const override {
    std::ofstream(path) << "half of it";
    throw WriteError(path, "the disk is full");
  }
};

}  // namespace

TEST_CASE("the extension chooses the format, in any case of letters") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(folder.write("mesh.OFF", triangle));
  CHECK(document.format == FileFormat::off);
  CHECK(document.point_count() == 3);
  write_mesh(folder / "mesh.Obj", document);
  CHECK(read_mesh(folder / "mesh.Obj").format == FileFormat::obj);
}

TEST_CASE("an unknown extension is refused where the content is unknown, too; the known ones are listed") {
  const ScratchFolder folder;
  const std::string unknown = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const MeshDocument document = read_mesh(folder.write("mesh.off", triangle));
  for (const std::string name : {"mesh.xyz", "mesh", "mesh.", "mesh.of", "mesh.offf", ".off"}) {
    CAPTURE(name);
    const std::string read_message = message_of<ReadError>([&] { read_mesh(folder.write(name, unknown)); });
    const std::string write_message = message_of<WriteError>([&] { write_mesh(folder / name, document); });
    for (const std::string& message : {read_message, write_message}) {
      CHECK(message.find((folder / name).string() + ": ") == 0);
    }
    CHECK(read_message.find(": off, obj, ") != std::string::npos);
    CHECK(write_message.find("known are .off, .obj, ") != std::string::npos);
    CHECK(bytes_of(folder / name) == unknown);
  }
}

TEST_CASE("what cannot be opened is named") {
  const ScratchFolder folder;
  fs::create_directory(folder / "folder.off");
  for (const std::string name : {"none.off", "folder.off", "none/mesh.off"}) {
    CHECK(message_of<ReadError>([&] { read_mesh(folder / name); }).find((folder / name).string() + ": ") == 0);
  }
}

TEST_CASE("a mesh can come through a pipe") {
  const ScratchFolder folder;
  const fs::path pipe = folder / "in.off";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe) << triangle; });
  const MeshDocument document = read_mesh(pipe);
  writer.join();
  CHECK(document.point_count() == 3);
  CHECK(document.cells.size() == 1);
}

TEST_CASE("a failing writer leaves the old file, no other, and names the target") {
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  MeshDocument document = read_mesh(folder.write("in.off", triangle));
  document.original = std::make_shared<FailingOriginal>();
  CHECK(message_of<WriteError>([&] { write_mesh(target, document); }) == target.string() + ": the disk is full");
  CHECK(bytes_of(target) == "old");
  CHECK(folder.size() == 2);
  CHECK_THROWS_AS(write_mesh(folder / "new.off", document), WriteError);
  CHECK(folder.size() == 2);
}

TEST_CASE("a mesh may be written over the file that it came from, permissions kept") {
  const ScratchFolder folder;
  const fs::path file = folder.write("mesh.off", triangle);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  MeshDocument document = read_mesh(file);
  document.points[3] = 2.5;
  write_mesh(file, document);
  CHECK(bytes_of(file) == "OFF\n3 1 0\n0 0 0\n2.5 0 0\n0 1 0\n3 0 1 2\n");
  CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(folder.size() == 1);
}

TEST_CASE("a symbolic link as target stays a link") {
  const ScratchFolder folder;
  const fs::path file = folder.write("mesh.off", "old");
  fs::create_symlink("mesh.off", folder / "link.off");
  write_mesh(folder / "link.off", read_mesh(folder.write("in.off", triangle)));
  CHECK(fs::is_symlink(folder / "link.off"));
  CHECK(bytes_of(file) == triangle);
}

TEST_CASE("a device as target is written, not replaced") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(folder.write("in.off", triangle));
  fs::create_symlink("/dev/null", folder / "null.off");
  write_mesh(folder / "null.off", document);
  CHECK(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", folder / "full.off");
    CHECK(message_of<WriteError>([&] {
            write_mesh(folder / "full.off", document);
          }).find((folder / "full.off").string() + ": ") == 0);
  }
}

TEST_CASE("arrays cannot be added to what is written back without arrays") {
  const ScratchFolder folder;
  const MeshDocument document = read_mesh(folder.write("in.off", triangle));
  trismooth::AddedArrays added;
  added.cell_arrays.push_back(trismooth::make_data_array("shape", 1, std::vector<double>{1}));
  CHECK_THROWS_AS(write_mesh(folder / "out.off", document, added), WriteError);
  CHECK_FALSE(fs::exists(folder / "out.off"));
}

TEST_CASE("a mesh with another number of points is not written into the original") {
  const ScratchFolder folder;
  MeshDocument document = read_mesh(folder.write("in.off", triangle));
  document.points.resize(12);
  CHECK_THROWS_AS(write_mesh(folder / "out.off", document), WriteError);
}

TEST_CASE("groups and sets without members come back from formats that hold them, and are told of elsewhere") {
  const ScratchFolder folder;
  MeshDocument document = read_mesh(folder.write("mesh.off", triangle));
  document.cell_arrays = {trismooth::make_data_array("region", 1, std::vector<std::int32_t>{1})};
  document.cell_arrays[0].description = std::make_shared<const trismooth::ArrayDescription>(
      trismooth::ArrayDescription{{}, {}, {{1, 2, "steel"}, {3, 1, "side"}, {9, 2, "spare"}}, {}});
  document.cell_sets = {{"later", {}}};
  document.point_sets = {{"nowhere", {}}};
  using enum FileFormat;
  for (const FileFormat format : {xdmf, exodus, med, cgns, unv, msh}) {
    if (!trismooth::is_available(format)) {
      continue;
    }
    CAPTURE(to_string(format));
    const fs::path path = folder / ("mesh" + std::string(codec_of(format).description.extensions[0]));
    write_mesh(path, document);
    std::vector<std::string> names = trismooth::names_of_empty_groups(read_mesh(path));
    std::ranges::sort(names);
    const std::string told = trismooth::list_text(what_is_lost(document, format));
    for (const std::string group : {"later", "nowhere", "side", "spare"}) {
      CAPTURE(group);
      CHECK(std::ranges::binary_search(names, group) != says(told, group));
    }
    CHECK(names.size() == (format == msh ? 3 : 4));
  }
  for (const FileFormat format : {FileFormat::inp, FileFormat::su2, FileFormat::sms, FileFormat::adcirc}) {
    CHECK(says(trismooth::list_text(what_is_lost(document, format)),
               " output has no groups without members: side, spare, later, nowhere are not written"));
  }
}

TEST_CASE("nothing is lost in the format that was read") {
  const ScratchFolder folder;
  const MeshDocument document =
      read_mesh(folder.write("in.off", "COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n"));
  CHECK(trismooth::what_is_lost(document, FileFormat::off).empty());
  CHECK_FALSE(trismooth::what_is_lost(document, FileFormat::obj).empty());
}
