// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/encoding/output_stream_buffer.h"

#include <ostream>
#include <sstream>
#include <string>

#include "trismooth/base/splitmix64.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::OutputStreamBuffer;
using trismooth::WriteError;

TEST_CASE("what is printed, here and there, arrives as in a string stream") {
  const ScratchFolder folder;
  const auto path = folder.write("file", "what was there before, and is longer than nothing");
  std::ostringstream expected;
  OutputStreamBuffer buffer(path);
  std::ostream stream(&buffer);
  std::uint64_t state = GENERATE(range(1, 6));
  const auto chance = [&state](std::uint64_t bound) { return trismooth::splitmix64(state++) % bound; };
  for (int step = 0; step < 300; ++step) {
    const std::string text(chance(10) == 0 ? chance(700'000) : chance(40), static_cast<char>('a' + chance(26)));
    for (std::ostream* const target : {static_cast<std::ostream*>(&expected), &stream}) {
      *target << text << std::flush;
    }
    REQUIRE(stream.tellp() == expected.tellp());
    const auto kind = chance(8);
    const auto back = static_cast<std::streamoff>(chance(static_cast<std::uint64_t>(expected.tellp()) + 1));
    for (std::ostream* const target : {static_cast<std::ostream*>(&expected), &stream}) {
      if (kind == 0) {
        target->seekp(back);
      } else if (kind == 1) {
        target->seekp(-back, std::ios_base::cur);
      } else if (kind == 2) {
        target->seekp(0, std::ios_base::end);
      } else if (kind == 3) {
        target->put('x');
      }
    }
    REQUIRE(stream.tellp() == expected.tellp());
  }
  buffer.close();
  CHECK(bytes_of(path) == expected.str());
}

TEST_CASE("who prints sees no failure, close() throws it") {
  OutputStreamBuffer buffer("/dev/full");
  std::ostream stream(&buffer);
  const std::string text(1'000'000, 'x');
  for (int i = 1; i <= 3; ++i) {
    stream << text << std::flush;
    CHECK(stream);
    CHECK(stream.tellp() == i * 1'000'000);
  }
  stream.seekp(5);
  stream << 'y';
  CHECK(stream.tellp() == 6);
  stream.seekp(0, std::ios_base::end);
  CHECK(stream.tellp() == 3'000'000);
  CHECK(message_of<WriteError>([&] { buffer.close(); }) == "/dev/full: cannot be written: No space left on device");
}

TEST_CASE("the last bytes failing is a failure") {
  OutputStreamBuffer buffer("/dev/full");
  std::ostream(&buffer) << 'x';
  CHECK_THROWS_AS(buffer.close(), WriteError);
}

TEST_CASE("a file that cannot be opened is told at once") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(OutputStreamBuffer(folder / "none/file"), WriteError);
}
