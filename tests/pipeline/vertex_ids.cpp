// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/pipeline/input/planar_mesh.h"

#include "catch.h"
#include "support/scratch_folder.h"

namespace trismooth::vertex_ids_test {

using Ids = std::vector<std::int32_t>;

Ids read(const std::string& text, std::int64_t vertex_count = 10) {
  const ScratchFolder folder;
  return read_vertex_ids(folder.write("fixed.txt", text), vertex_count);
}

/// The message without the folder of the file.
std::string failure_of(const std::string& text, std::int64_t vertex_count = 10) {
  const std::string message = message_of<ReadError>([&] { read(text, vertex_count); });
  const std::size_t name = message.find("fixed.txt");
  return name == std::string::npos ? message : message.substr(name);
}

TEST_CASE("vertex numbers stand between any white space and comments, in any order and as often as they like") {
  CHECK(read("3 1\t4\r\n1\n\n  5\r9") == Ids{3, 1, 4, 1, 5, 9});
  CHECK(read("# the hole's rim\n0 # its lowest\n#1\n 2#3\n4") == Ids{0, 2, 4});
  CHECK(read("\xEF\xBB\xBF"
             "3 1\n") == Ids{3, 1});
  CHECK(read("").empty());
  CHECK(read(" \n# nothing\n").empty());
  CHECK(read("007\n") == Ids{7});
}

TEST_CASE("a number that is no vertex is refused with its line") {
  CHECK(read("9") == Ids{9});
  for (const std::string bad : {"10", "-1", "4294967296", "99999999999999999999"}) {
    CAPTURE(bad);
    const std::string message = failure_of("1\n# two\n2 " + bad + "\n3\n");
    CHECK(message.find("fixed.txt:3: ") == 0);
    CHECK(message.find(bad) != std::string::npos);
  }
  CHECK(failure_of("0", 0) == "fixed.txt: names vertices, but the mesh has none; leave the file out");
}

TEST_CASE("what is no whole number is refused with its line") {
  for (const std::string bad : {"x", "1.5", "1e1", "0x1", "1,", "2;3", "--1", "nan", "\xef\xbf\xbd"}) {
    CAPTURE(bad);
    const std::string message = failure_of("1\n" + bad + "\n");
    CHECK(message.find("fixed.txt:2: ") == 0);
    CHECK(message.find("a vertex number") != std::string::npos);
  }
}

TEST_CASE("a file of vertex numbers that is not there is named") {
  const ScratchFolder folder;
  const auto path = folder / "none.txt";
  CHECK(message_of<ReadError>([&] { read_vertex_ids(path, 1); }).find(path.string() + ": ") == 0);
}

}  // namespace trismooth::vertex_ids_test
