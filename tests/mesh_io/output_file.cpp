#include "trismooth/mesh_io/output_file.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::OutputFile;
using trismooth::WriteError;

namespace fs = std::filesystem;

namespace {

void put(const OutputFile& output, std::string_view text) {
  std::ofstream(output.path(), std::ios::binary) << text;
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

}  // namespace

TEST_CASE("nothing shows under the target's name before the commit, all of it after") {
  const ScratchFolder folder;
  const fs::path target = folder / "mesh.off";
  {
    OutputFile output(target);
    CHECK(output.path() != target);
    CHECK(output.path().parent_path() == target.parent_path());
    CHECK(output.path().extension() == ".off");
    put(output, "new");
    CHECK_FALSE(fs::exists(target));
    output.commit();
  }
  CHECK(bytes_of(target) == "new");
  CHECK(folder.size() == 1);
}

TEST_CASE("without a commit the target stays and nothing is left behind") {
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  {
    const OutputFile output(target);
    put(output, "new");
  }
  CHECK(bytes_of(target) == "old");
  CHECK(folder.size() == 1);
}

TEST_CASE("two files for one target do not meet") {
  const ScratchFolder folder;
  OutputFile one(folder / "mesh.off");
  OutputFile two(folder / "mesh.off");
  CHECK(one.path() != two.path());
}

TEST_CASE("the permissions are those of the file replaced, else those of any new file") {
  const ScratchFolder folder;
  const mode_t permissions = GENERATE(0640, 0600, 0755);
  const fs::path target = folder.write("mesh.off", "old");
  ::chmod(target.c_str(), permissions);
  OutputFile replacing(target);
  replacing.commit();
  CHECK(mode_of(target) == permissions);

  OutputFile fresh(folder / "fresh.off");
  fresh.commit();
  CHECK(mode_of(folder / "fresh.off") == mode_of(folder.write("plain", "")));
}

TEST_CASE("a symbolic link stays a link, its target is written") {
  const ScratchFolder folder;
  fs::create_directory(folder / "data");
  const fs::path link = folder / "link.off";
  fs::create_symlink("data/second.off", link);
  fs::create_symlink("mesh.off", folder / "data/second.off");
  SECTION("that exists") {
    folder.write("data/mesh.off", "old");
  }
  SECTION("that does not exist") {}
  OutputFile output(link);
  put(output, "new");
  output.commit();
  CHECK(fs::is_symlink(link));
  CHECK(fs::is_symlink(folder / "data/second.off"));
  CHECK(fs::is_regular_file(fs::symlink_status(folder / "data/mesh.off")));
  CHECK(bytes_of(link) == "new");
}

TEST_CASE("links that lead nowhere are refused") {
  const ScratchFolder folder;
  fs::create_symlink("b.off", folder / "a.off");
  fs::create_symlink("a.off", folder / "b.off");
  CHECK_THROWS_AS(OutputFile(folder / "a.off"), WriteError);
}

TEST_CASE("devices and pipes are written directly") {
  const ScratchFolder folder;
  REQUIRE(::mkfifo((folder / "pipe.off").c_str(), 0600) == 0);
  for (const fs::path& target : {fs::path("/dev/null"), folder / "pipe.off"}) {
    CAPTURE(target.string());
    OutputFile output(target);
    CHECK(output.path() == target);
    output.commit();
    CHECK_FALSE(fs::is_regular_file(target));
    CHECK(fs::exists(target));
  }
}

TEST_CASE("a place where no file can be made is refused and named") {
  const ScratchFolder folder;
  const fs::path missing = folder / "none/mesh.off";
  CHECK(message_of<WriteError>([&] { OutputFile output(missing); }).find(missing.string() + ": ") == 0);
  CHECK(message_of<WriteError>([&] { OutputFile output(folder.path()); }).find(folder.path().string() + ": ") == 0);
  CHECK_THROWS_AS(OutputFile(folder.write("file", "") / "mesh.off"), WriteError);
}

TEST_CASE("a file that may not be written stays") {
  if (::geteuid() == 0) {
    return;  // root may write anything
  }
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  ::chmod(target.c_str(), 0400);
  CHECK_THROWS_AS(OutputFile(target), WriteError);
  CHECK(bytes_of(target) == "old");
  CHECK(folder.size() == 1);
}

TEST_CASE("long names leave room for the temporary one") {
  const ScratchFolder folder;
  const fs::path target = folder / (std::string(251, 'x') + ".off");
  OutputFile output(target);
  output.commit();
  CHECK(fs::exists(target));
}

TEST_CASE("a name without a folder is in the current one") {
  const ScratchFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  {
    OutputFile output("mesh.off");
    put(output, "new");
    output.commit();
  }
  fs::current_path(before);
  CHECK(bytes_of(folder / "mesh.off") == "new");
}

TEST_CASE("an abrupt end can remove what is unfinished, and only that") {
  const ScratchFolder folder;
  OutputFile finished(folder / "finished.off");
  finished.commit();
  const OutputFile unfinished(folder / "unfinished.off");
  CHECK(folder.size() == 2);
  OutputFile::remove_unfinished();
  CHECK(folder.size() == 1);
  CHECK(fs::exists(folder / "finished.off"));
}
