// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/text_mesh_writer.h"

#include <cstdint>
#include <limits>
#include <string>

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::FileWorkers;
using trismooth::MemoryBlock;
using trismooth::TextBlock;
using trismooth::TextLines;
using trismooth::TextMeshWriter;

namespace {

std::string text_in(const MemoryBlock& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class T>
std::string digits_of(T value) {
  MemoryBlock bytes;
  TextBlock(bytes).number(value);
  return text_in(bytes);
}

template <class T>
void check_digits_of_limits() {
  for (const T value : {std::numeric_limits<T>::min(), T{0}, T{1}, std::numeric_limits<T>::max()}) {
    CHECK(digits_of(value) == std::to_string(value));
  }
}

}  // namespace

TEST_CASE("whole numbers of every type are their digits, also those of one byte") {
  check_digits_of_limits<std::int8_t>();
  check_digits_of_limits<std::uint8_t>();
  check_digits_of_limits<std::int16_t>();
  check_digits_of_limits<std::uint16_t>();
  check_digits_of_limits<std::int32_t>();
  check_digits_of_limits<std::uint32_t>();
  check_digits_of_limits<std::int64_t>();
  check_digits_of_limits<std::uint64_t>();
}

TEST_CASE("numbers of floating point are the shortest text of their own type") {
  CHECK(digits_of(0.1) == "0.1");
  CHECK(digits_of(0.1F) == "0.1");
  CHECK(digits_of(static_cast<double>(0.1F)) == "0.10000000149011612");
  CHECK(digits_of(-0.0) == "-0");
  CHECK(digits_of(std::numeric_limits<double>::lowest()) == "-1.7976931348623157e+308");
  CHECK(digits_of(std::numeric_limits<double>::denorm_min()) == "5e-324");
}

TEST_CASE("text grows behind what a block holds, and none adds nothing") {
  MemoryBlock bytes;
  TextBlock(bytes).text("").text("a").number(1).text('\n').text("").text("bc");
  TextBlock(bytes).text("d");
  CHECK(text_in(bytes) == "a1\nbcd");
}

TEST_CASE("a blank stands between two words of a line, and nowhere else") {
  const ScratchFolder folder;
  for (const std::size_t part_bytes : {std::size_t{1}, std::size_t{128}, FileWorkers::whole}) {
    trismooth::Workers three(3);
    TextMeshWriter writer(folder / "mesh", FileWorkers(three, part_bytes));
    writer.write_line([](TextLines& line) { line.word("first"); });
    writer.write_line([](TextLines& /*line*/) {});
    writer.write_lines(0, [](TextLines& lines, std::size_t /*i*/) { lines.word("never"); });
    writer.write_lines(7, [](TextLines& lines, std::size_t i) {
      if (i % 2 == 0) {
        lines.word("v").number(i).number(0.5).end_line();
      }
    });
    writer.close();
    CHECK(bytes_of(folder / "mesh") == "first\n\nv 0 0.5\nv 2 0.5\nv 4 0.5\nv 6 0.5\n");
  }
}
