// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/report/labelled_line.h"

#include <sstream>
#include <string>

#include "catch.h"

namespace trismooth::labelled_line_test {

TEST_CASE("a short line stays one, with its text in the thirteenth column") {
  CHECK(labelled_line("written:", "out.vtk") == "written:    out.vtk\n");
  CHECK(labelled_line("", "more") == "            more\n");
  CHECK(labelled_line("x:", "") == "x:          \n");
}

TEST_CASE("text is broken at blanks into lines of 80 columns at most, no word is lost") {
  std::string text;
  for (int i = 0; i < 200; ++i) {
    text +=
        (i == 0 ? "" : " ") + std::string(1 + static_cast<std::size_t>(i * 7 % 13), static_cast<char>('a' + i % 26));
  }
  const std::string lines = wrapped(text, "- ", "    ");
  CHECK(lines.back() == '\n');
  std::istringstream stream(lines);
  std::string joined;
  for (std::string line; std::getline(stream, line);) {
    CHECK(line.size() <= 80);
    CHECK(line.substr(0, 2) == (joined.empty() ? "- " : "  "));
    joined += (joined.empty() ? "" : " ") + line.substr(joined.empty() ? 2 : 4);
  }
  CHECK(joined == text);
}

TEST_CASE("a line of exactly 80 columns is not broken, one of 81 is") {
  CHECK(wrapped(std::string(40, 'a') + ' ' + std::string(39, 'b'), "", "").find('\n') == 80);
  CHECK(wrapped(std::string(40, 'a') + ' ' + std::string(40, 'b'), "", "").find('\n') == 40);
}

TEST_CASE("a word that is too long for a line has one of its own") {
  const std::string path(200, 'p');
  CHECK(labelled_line("input:", path + ": 3 vertices") == "input:      " + path + ":\n            3 vertices\n");
}

TEST_CASE("no value of a line can begin another line or steer the terminal") {
  CHECK(labelled_line("input:", "a\nwritten:    b\r\x1b[K") == "input:      a\\x0awritten:    b\\x0d\\x1b[K\n");
}

}  // namespace trismooth::labelled_line_test
