// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/bytes/output_file.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
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

TEST_CASE("the permissions are those of the old file, too, where it is removed meanwhile") {
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  ::chmod(target.c_str(), 0644);
  OutputFile replacing(target);
  fs::remove(target);
  replacing.commit();
  CHECK(mode_of(target) == 0644);
}

TEST_CASE("what replaces a private file is private from the start") {
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  ::chmod(target.c_str(), 0600);
  const OutputFile output(target);
  CHECK(mode_of(output.path()) == 0600);
}

TEST_CASE("a file that its owner may not read can be replaced") {
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  ::chmod(target.c_str(), 0200);
  OutputFile output(target);
  put(output, "new");
  output.commit();
  CHECK(mode_of(target) == 0200);
  ::chmod(target.c_str(), 0600);
  CHECK(bytes_of(target) == "new");
}

TEST_CASE("root's writing leaves a file to its owner") {
  if (::geteuid() != 0) {
    return;  // others can give nothing away
  }
  const ScratchFolder folder;
  const fs::path target = folder.write("mesh.off", "old");
  REQUIRE(::chown(target.c_str(), 12345, 54321) == 0);
  OutputFile output(target);
  output.commit();
  struct stat status {};
  REQUIRE(::stat(target.c_str(), &status) == 0);
  CHECK(status.st_uid == 12345);
  CHECK(status.st_gid == 54321);
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

TEST_CASE("a pipe that nobody reads any more is an error of the write") {
  const ScratchFolder folder;
  const fs::path pipe = folder / "pipe.off";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  {
    const OutputFile output(pipe);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    const int writer = ::open(pipe.c_str(), O_WRONLY);
    ::close(reader);
    CHECK(::write(writer, "x", 1) == -1);
    CHECK(errno == EPIPE);
    ::close(writer);
  }
  sigset_t blocked;
  sigset_t pending;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  ::sigpending(&pending);
  CHECK(sigismember(&blocked, SIGPIPE) == 0);
  CHECK(sigismember(&pending, SIGPIPE) == 0);
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

TEST_CASE("long names leave room for the temporary one, which cuts no character in two") {
  const ScratchFolder folder;
  std::string accented = "x";
  while (accented.size() < 249) {
    accented += "\xc3\xa9";
  }
  for (const std::string& stem : {std::string(251, 'x'), accented, std::string(250, '\x80')}) {
    const fs::path target = folder / (stem + ".off");
    OutputFile output(target);
    const std::string name = output.path().filename().string();
    CHECK(name.size() <= 143);
    CHECK(std::ranges::count(name, '\xc3') == std::ranges::count(name, '\xa9'));
    output.commit();
    CHECK(fs::exists(target));
  }
}

TEST_CASE("a commit fails where the target has become a folder, or its folder is gone, and names what was asked for") {
  const ScratchFolder folder;
  fs::create_directory(folder / "data");
  fs::create_symlink("data/mesh.off", folder / "link.off");
  OutputFile output(folder / "link.off");
  SECTION("become a folder") {
    fs::create_directory(folder / "data/mesh.off");
  }
  SECTION("gone") {
    fs::remove_all(folder / "data");
  }
  CHECK(message_of<WriteError>([&] { output.commit(); }).find((folder / "link.off").string() + ": cannot be ") == 0);
}

TEST_CASE("what is taken back leaves the file that was there, and no new one") {
  const ScratchFolder folder;
  const fs::path old = folder.write("old.off", "old");
  fs::permissions(old, fs::perms::owner_read | fs::perms::owner_write);
  {
    OutputFile replacing(old);
    OutputFile fresh(folder / "fresh.off");
    for (OutputFile* const file : {&replacing, &fresh}) {
      put(*file, "new");
      file->commit();
      CHECK(bytes_of(file == &fresh ? folder / "fresh.off" : old) == "new");
    }
    replacing.take_back();
    fresh.take_back();
    fresh.take_back();
    CHECK(bytes_of(old) == "old");
  }
  CHECK(bytes_of(old) == "old");
  CHECK(mode_of(old) == 0600);
  CHECK(folder.size() == 1);
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

TEST_CASE("who gives up before the first commit ends with nothing written, once") {
  const ScratchFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const std::uint64_t before = OutputFile::commits_begun();
    OutputFile(folder / "first.off").commit();
    const OutputFile unfinished(folder / "second.off");
    const bool too_late = !OutputFile::give_up(before) && fs::exists(unfinished.path());
    const bool gives_up = OutputFile::give_up(before + 1) && !fs::exists(unfinished.path());
    ::_exit(too_late && gives_up && !OutputFile::give_up(before + 1) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
}
