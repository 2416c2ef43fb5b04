// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/printable_text.h"

#include <string>

#include "catch.h"

namespace trismooth::printable_text_test {

TEST_CASE("ordinary text of any script stays as it is") {
  for (const std::string text :
       {"", "plate.vtk: 3 vertices", "back\\slash \\x1b", "Stra\xc3\x9f\x65", "\xe6\x9d\x90\xe6\x96\x99",
        "\xd7\xa9\xd7\x9c\xd7\x95\xd7\x9d", "\xf0\x9f\x98\x80", "e\xcc\x81", "\xc2\xa0"}) {
    CHECK(printable(text) == text);
  }
}

TEST_CASE("every control character stands as its number") {
  for (int code = 0; code < 0x20; ++code) {
    const char hex[] = "0123456789abcdef";
    const std::string expected = {'a', '\\', 'x', hex[code / 16], hex[code % 16], 'b'};
    CHECK(printable(std::string{'a', static_cast<char>(code), 'b'}) == expected);
  }
  CHECK(printable("\x7f") == "\\x7f");
  CHECK(printable("\xc2\x80") == "\\u0080");
  CHECK(printable("\xc2\x9b[2J") == "\\u009b[2J");  // a control sequence introducer in one character
  CHECK(printable("\xc2\x9f") == "\\u009f");
  CHECK(printable("\x1b]0;title\a") == "\\x1b]0;title\\x07");
}

TEST_CASE("what turns the direction of its neighbours or ends a line stands as its number") {
  // NOLINTBEGIN(misc-misleading-bidirectional): these are what is tested
  CHECK(printable("a\xe2\x80\xae"
                  "gnp.exe") == "a\\u202egnp.exe");
  for (const std::string code :
       {"\xd8\x9c", "\xe2\x80\x8e", "\xe2\x80\x8f", "\xe2\x80\xa8", "\xe2\x80\xa9", "\xe2\x80\xaa", "\xe2\x80\xab",
        "\xe2\x80\xac", "\xe2\x80\xad", "\xe2\x81\xa6", "\xe2\x81\xa7", "\xe2\x81\xa8", "\xe2\x81\xa9"}) {
    CHECK(printable(code).substr(0, 2) == "\\u");
    CHECK(printable(code).size() == 6);
  }
  // NOLINTEND(misc-misleading-bidirectional)
}

TEST_CASE("bytes that are no UTF-8 stand one by one as their number") {
  CHECK(printable("a\xff\x9b[2J") == "a\\xff\\x9b[2J");
  CHECK(printable("\xe2\x80") == "\\xe2\\x80");
  CHECK(printable("\xc0\x9b") == "\\xc0\\x9b");
}

TEST_CASE("line feeds stay where there are several lines, and escaping twice is the same as once") {
  CHECK(printable_lines("one\ntwo\r\n") == "one\ntwo\\x0d\n");
  CHECK(printable("one\ntwo") == "one\\x0atwo");
  std::string all;
  for (int byte = 0; byte < 256; ++byte) {
    all += static_cast<char>(byte);
  }
  CHECK(printable(printable(all)) == printable(all));
  CHECK(printable_lines(printable_lines(all)) == printable_lines(all));
}

}  // namespace trismooth::printable_text_test
