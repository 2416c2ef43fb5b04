// SPDX-License-Identifier: BSD-3-Clause
#ifdef TRISMOOTH_HAS_HDF5

#include "trismooth/mesh_io/hdf5/hdf5_child.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"

#include "catch.h"
#include "support/memory_file.h"
#include "support/sanitized.h"
#include "support/small_hdf5.h"

using trismooth::Hdf5Channel;
using trismooth::Hdf5Child;
using trismooth::Hdf5ChildLost;
using trismooth::Hdf5Reader;
using trismooth::Hdf5Refusal;
using trismooth::ReadError;

namespace trismooth::hdf5_child_test {
namespace {

/// The address sanitizer's memory, other than the C library's, cannot be copied to a child while threads ask for some.
constexpr int threads_at_once = is_sanitized ? 1 : 6;

constexpr Hdf5Child::Limits few{2, std::uint64_t{64} << 20};

/// A file with packed numbers, for which the child is asked, and a text of some length.
std::string small_file() {
  test_support::SmallHdf5 file;
  file.group("/a");
  file.values("/a/packed", std::vector<double>(1000, 1.5), test_support::SmallHdf5::Layout::deflated);
  file.values("/a/plain", std::vector<std::int32_t>{1, 2, 3});
  file.attribute("/a", "number", 7);
  return file.bytes();
}

/// No child of this process is there, running or not yet waited for.
bool has_no_children() {
  return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

/// The one that there is.
pid_t only_child() {
  pid_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    pid_t process = 0;
    pid_t parent = 0;
    std::string name;
    char state = ' ';
    if (stat >> process >> name >> state >> parent && parent == ::getpid()) {
      CHECK(found == 0);
      found = process;
    }
  }
  REQUIRE(found > 0);
  return found;
}

std::string loss_of(Hdf5Child& child) {
  return message_of<Hdf5ChildLost>([&] {
    child.ask("?");
    child.answer(100);
  });
}

}  // namespace

TEST_CASE("a child of HDF5 answers and refuses, and is gone with its object") {
  {
    Hdf5Child child(few, [](Hdf5Channel& channel) {
      while (const auto request = channel.next()) {
        request == "no" ? channel.refuse("it is\nnot") : channel.answer(*request + *request);
      }
    });
    child.ask("ab");
    CHECK(child.answer(4) == "abab");
    const std::string large(3 << 20, 'x');
    child.ask(large);
    CHECK((child.answer(6 << 20) == large + large));
    child.ask("no");
    CHECK(message_of<Hdf5Refusal>([&] { child.answer(4); }) == "it is?not");
    child.ask("ab");
    CHECK_THROWS_AS(child.answer(3), Hdf5ChildLost);
    CHECK_THROWS_AS(child.ask("ab"), Hdf5ChildLost);
  }
  CHECK(has_no_children());
}

TEST_CASE("a child of HDF5 that breaks off, lies or gives no answer is lost, and leaves nothing behind") {
  {
    Hdf5Child crashed(few, [](Hdf5Channel& /*channel*/) { std::raise(SIGSEGV); });
    CHECK(loss_of(crashed) == "is damaged: HDF5's library has broken off at it");
    CHECK(loss_of(crashed) == "is damaged: HDF5's library has broken off at it");
    Hdf5Child thrown(few, [](Hdf5Channel& /*channel*/) { throw 1; });
    CHECK(loss_of(thrown) == "is damaged: HDF5's library has broken off at it");
    Hdf5Child gone(few, [](Hdf5Channel& /*channel*/) {});
    CHECK(loss_of(gone) == "is damaged: HDF5's library has broken off at it");
    Hdf5Child killed(few, [](Hdf5Channel& /*channel*/) { std::raise(SIGKILL); });
    CHECK(loss_of(killed) == "cannot be read: HDF5's process was killed, as happens where memory runs out");
    // Headers of sizes that no memory has, and of which less comes than they say.
    for (const std::uint64_t size : {~std::uint64_t{0}, std::uint64_t{1} << 40, std::uint64_t{90}}) {
      Hdf5Child liar(few, [size](Hdf5Channel& /*channel*/) {
        const std::uint64_t header[2]{size, 0};
        [[maybe_unused]] const auto written = ::write(3, header, sizeof(header));
      });
      CHECK_THROWS_AS(liar.answer(100), Hdf5ChildLost);
    }
    // Neither at rest nor at work longer than it may, whether or not anybody waits for an answer.
    Hdf5Child endless({1, 0}, [](Hdf5Channel& /*channel*/) {
      for (volatile bool goes_on = true; goes_on;) {
      }
    });
    // On a machine with much else to do its time by the clock may be over first.
    const std::string loss = loss_of(endless);
    CHECK((loss == "is damaged: HDF5's library comes to no end with it" ||
           loss == "is damaged: HDF5's library gives no answer"));
    Hdf5Child silent({0, 0}, [](Hdf5Channel& /*channel*/) { ::pause(); });
    CHECK(loss_of(silent) == "is damaged: HDF5's library gives no answer");
    const Hdf5Child deaf(few, [](Hdf5Channel& /*channel*/) {
      for (;;) {
        ::pause();
      }
    });
  }
  CHECK(has_no_children());
}

TEST_CASE(
    "a child of HDF5 has no file of its parent, opens none, takes no memory beyond its limit, and prints nothing") {
  const test_support::MemoryFile printed;
  const int standard_error = ::dup(STDERR_FILENO);
  const int to = ::open(printed.path().c_str(), O_WRONLY);
  ::dup2(to, STDERR_FILENO);
  {
    Hdf5Child child(few, [](Hdf5Channel& channel) {
      [[maybe_unused]] const auto said = ::write(STDERR_FILENO, "!", 1);
      int open = 0;
      for (int descriptor = 0; descriptor < 1000; ++descriptor) {
        open += ::fcntl(descriptor, F_GETFD) >= 0 ? 1 : 0;
      }
      const bool opens = ::open("/dev/null", O_RDONLY) >= 0;
      const bool takes = ::mmap(nullptr, std::size_t{1} << 30, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                                0) != MAP_FAILED;
      rlimit core{};
      ::getrlimit(RLIMIT_CORE, &core);
      channel.answer(std::to_string(open) + (opens ? " opens" : "") + (takes ? " takes" : "") +
                     (core.rlim_cur != 0 ? " dumps" : ""));
    });
    CHECK(child.answer(100) == "4");
  }
  ::dup2(standard_error, STDERR_FILENO);
  ::close(standard_error);
  ::close(to);
  CHECK(printed.bytes().empty());
  CHECK(has_no_children());
}

TEST_CASE("where a child of HDF5 is killed while it serves, that is said, and later what else is asked for") {
  const std::string bytes = small_file();
  {
    const Hdf5Reader reader("a.h5", bytes);
    CHECK(reader.read<double>("/a/packed") == std::vector<double>(1000, 1.5));
    ::kill(only_child(), SIGSEGV);
    CHECK(message_of<ReadError>([&] { reader.read<double>("/a/packed"); }) ==
          "a.h5: '/a/packed' is damaged: HDF5's library has broken off at it");
    CHECK(message_of<ReadError>([&] { reader.has_attribute("/a", "number"); }) ==
          "a.h5: '/a:number' is damaged: HDF5's library has broken off at it");
    CHECK(has_no_children());
  }
  CHECK(has_no_children());
}

TEST_CASE("a program that wants no news of its children reads HDF5 as well, and where it is told to stop goes on") {
  const std::string bytes = small_file();
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  {
    const Hdf5Reader reader("a.h5", bytes);
    const pid_t child = only_child();
    ::kill(child, SIGINT);
    ::kill(child, SIGTERM);
    CHECK(reader.read_attribute<std::int32_t>("/a", "number") == std::vector<std::int32_t>{7});
  }
  std::signal(SIGCHLD, before);
  CHECK(has_no_children());
}

TEST_CASE("where no process can be made for HDF5, it is said why") {
  const std::string bytes = small_file();
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{0, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);
  std::string message;
  try {
    const Hdf5Reader reader("a.h5", bytes);
  } catch (const ReadError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
  CHECK(message.starts_with("a.h5: is read by HDF5 in a process of its own, and none can be made: "));
  CHECK(message.find("ulimit -n") != std::string::npos);
}

TEST_CASE("however an HDF5 file is damaged, it is read or refused, and nothing is left running") {
  const std::string bytes = small_file();
  int read = 0;
  int refused = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    CAPTURE(i);
    std::string damaged = bytes;
    for (std::size_t k = 0; k <= i % 4; ++k) {
      damaged[(i * 7919 + k * 104729) % bytes.size()] = static_cast<char>(i * 31 + k * 17);
    }
    try {
      const Hdf5Reader reader("a.h5", damaged);
      for (const auto& member : reader.members("/a")) {
        const std::string path = "/a/" + member.name;
        if (reader.shape_of(path).type) {
          reader.read<double>(path);
        }
        reader.attribute_names(path);
      }
      reader.read_attribute<std::int32_t>("/a", "number");
      ++read;
    } catch (const ReadError&) {
      ++refused;
    }
  }
  CHECK(read > 0);
  CHECK(refused > 0);
  CHECK(has_no_children());
}

TEST_CASE("readers in several threads, and threads at one reader, each get what they ask for") {
  const std::string bytes = small_file();
  std::atomic<int> right{0};
  {
    const Hdf5Reader shared("a.h5", bytes);
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < threads_at_once; ++thread) {
      threads.emplace_back([&] {
        for (int i = 0; i < 10; ++i) {
          const Hdf5Reader own("a.h5", bytes);
          const bool same = own.read<double>("/a/packed") == std::vector<double>(1000, 1.5) &&
                            shared.read<double>("/a/packed") == std::vector<double>(1000, 1.5) &&
                            shared.read_attribute<std::int32_t>("/a", "number") == std::vector<std::int32_t>{7};
          right += same ? 1 : 0;
        }
      });
    }
  }
  CHECK(right == 10 * threads_at_once);
  CHECK(has_no_children());
}

}  // namespace trismooth::hdf5_child_test

#endif
