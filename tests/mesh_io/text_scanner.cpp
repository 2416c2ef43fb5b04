// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/text/text_scanner.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/scratch_folder.h"

using trismooth::ReadError;
using trismooth::TextScanner;
using Comments = TextScanner::Comments;
using Continuation = TextScanner::Continuation;

namespace {

std::vector<std::string> tokens_of(TextScanner scanner) {
  std::vector<std::string> tokens;
  while (!scanner.at_end()) {
    tokens.emplace_back(scanner.next_token("a token"));
  }
  return tokens;
}

std::string failure_of(const std::string& text, void (*read)(TextScanner&)) {
  return message_of<ReadError>([&] {
    TextScanner scanner(text, "mesh.txt", Comments::hash);
    read(scanner);
  });
}

}  // namespace

TEST_CASE("tokens are split at blanks and at any line end") {
  CHECK(tokens_of({"a b\tc\vd\fe", ""}) == std::vector<std::string>{"a", "b", "c", "d", "e"});
  CHECK(tokens_of({"\n\r\n a\r\rb\r\nc\n\n", ""}) == std::vector<std::string>{"a", "b", "c"});
  CHECK(tokens_of({"", ""}).empty());
  CHECK(tokens_of({" \t\r\n", ""}).empty());
}

TEST_CASE("a comment runs to the end of its line, only where comments are asked for") {
  const std::string text = "a#b c\rd # e\n#f\n\ng#";
  CHECK(tokens_of({text, "", Comments::hash}) == std::vector<std::string>{"a", "d", "g"});
  CHECK(tokens_of({text, ""}) == std::vector<std::string>{"a#b", "c", "d", "#", "e", "#f", "g#"});
}

TEST_CASE("a backslash at the end of a line joins it with the next, only where that is asked for") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    CAPTURE(end);
    const std::string text = replace_all(R"(a \@ b\@c\d@e)", "@", end);
    TextScanner scanner(text, "", Comments::hash, 0, Continuation::backslash);
    CHECK(scanner.next_token("a") == "a");
    CHECK_FALSE(scanner.at_end_of_line());
    CHECK(scanner.next_token("b") == "b");
    CHECK_FALSE(scanner.at_end_of_line());
    CHECK(scanner.next_token("c\\d") == "c\\d");
    CHECK(scanner.at_end_of_line());
    CHECK(scanner.next_token("e") == "e");
    CHECK(tokens_of({text, ""}) == std::vector<std::string>{"a", "\\", "b\\", "c\\d", "e"});
  }
  CHECK(tokens_of({"a\\", "", Comments::none, 0, Continuation::backslash}) == std::vector<std::string>{"a\\"});
}

TEST_CASE("the end of a line is seen through blanks and comments, not through lines") {
  TextScanner scanner("a \t# comment\n b", "", Comments::hash);
  CHECK_FALSE(scanner.at_end_of_line());
  scanner.next_token("a");
  CHECK(scanner.at_end_of_line());
  CHECK_FALSE(scanner.at_end());
  CHECK_FALSE(scanner.at_end_of_line());
  scanner.next_token("b");
  CHECK(scanner.at_end_of_line());
  CHECK(scanner.at_end());
}

TEST_CASE("offsets point at tokens, also after a start that is not zero") {
  const std::string text = "xx 12  345";
  TextScanner scanner(text, "", Comments::none, 2);
  CHECK(scanner.peek_token() == "12");
  CHECK(scanner.next_integer("a number", 0, 100) == 12);
  CHECK(scanner.token_offset() == 3);
  CHECK(scanner.offset() == 5);
  CHECK(scanner.next_double("a number") == 345.0);
  CHECK(scanner.token_offset() == 7);
  scanner.seek(8);
  CHECK(scanner.next_token("a number") == "45");
}

TEST_CASE("a Ctrl-Z ends the text where only white space follows, and is a character elsewhere") {
  for (const std::string text : {"a 1\x1a", "a 1\n\x1a", "a 1 \x1a\r\n \n"}) {
    CAPTURE(text);
    TextScanner scanner(text, "mesh");
    CHECK(scanner.next_token("a") == "a");
    CHECK_FALSE(scanner.at_end_of_line());
    CHECK(scanner.next_integer("a number", 0, 9) == 1);
    CHECK(scanner.at_end_of_line());
    CHECK(scanner.at_end());
  }
  TextScanner lines("one\nlast\x1a", "mesh");
  lines.next_line();
  CHECK(lines.next_line() == "last");
  CHECK(lines.at_end());
  TextScanner within("a\x1a b", "mesh");
  CHECK(within.next_token("a word") == "a\x1a");
  CHECK(within.next_token("a word") == "b");
}

TEST_CASE("lines are taken as they are") {
  TextScanner scanner("a # b\r\n\rc\\\nd", "", Comments::hash, 0, Continuation::backslash);
  scanner.next_token("a");
  CHECK(scanner.next_line() == " # b");
  CHECK(scanner.next_line().empty());
  CHECK(scanner.next_line() == "c\\");
  CHECK(scanner.next_line() == "d");
  CHECK(scanner.at_end());
  CHECK(scanner.next_line().empty());
}

TEST_CASE("whole numbers never wrap around") {
  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  TextScanner all("9223372036854775807 -9223372036854775808 +7 -0", "");
  CHECK(all.next_integer("n", lowest, highest) == highest);
  CHECK(all.next_integer("n", lowest, highest) == lowest);
  CHECK(all.next_integer("n", lowest, highest) == 7);
  CHECK(all.next_integer("n", lowest, highest) == 0);
  for (const char* token : {"9223372036854775808", "-9223372036854775809", "18446744073709551621", "4294967301"}) {
    CAPTURE(token);
    const std::string message =
        message_of<ReadError>([&] { TextScanner(token, "f").next_integer("an index", 0, 100); });
    CHECK(message == "f:1: expected an index from 0 to 100, got '" + std::string(token) + "'");
  }
  for (const char* token : {"1.0", "1e3", "x", "-", "+", "--1", "+-1", "0x10", "1,"}) {
    CAPTURE(token);
    const std::string message =
        message_of<ReadError>([&] { TextScanner(token, "f").next_integer("an index", 0, 100); });
    CHECK(message == "f:1: expected an index (a whole number), got '" + std::string(token) + "'");
  }
}

TEST_CASE("only finite numbers are numbers") {
  for (const char* token : {"nan", "-nan", "inf", "-Infinity", "1e999", "abc", "1.5.2", "0x1p3", "1,5"}) {
    CAPTURE(token);
    CHECK_THROWS_AS(TextScanner(token, "").next_double("a number"), ReadError);
  }
  CHECK(TextScanner("1e39", "").next_double("a number") == 1e39);
  CHECK(TextScanner("1e-999", "").next_double("a number") == 0.0);
}

TEST_CASE("messages name the line, whatever ends lines") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = replace_all("1@# 2@@x", "@", end);
    CHECK(failure_of(text, [](TextScanner& scanner) {
            scanner.next_double("a number");
            scanner.next_double("a number");
          }) == "mesh.txt:4: expected a number (a finite number), got 'x'");
  }
  CHECK(failure_of("1\n2\n", [](TextScanner& scanner) {
          scanner.next_token("a number");
          scanner.next_token("a number");
          scanner.next_token("a third");
        }) == "mesh.txt:3: expected a third, got the end of the file");
  CHECK(failure_of("a\nb\nc", [](TextScanner& scanner) { scanner.fail_at(2, "is wrong"); }) == "mesh.txt:2: is wrong");
}

TEST_CASE("tokens in messages are short and printable") {
  CHECK(trismooth::quoted("abc") == "'abc'");
  // Characters of UTF-8 stay; the last that begins within 40 bytes is whole.
  CHECK(trismooth::quoted(std::string("a\0\x1b\xff\xc3\xa9\xc2\x85", 8)) == "'a\\x00\\x1b\\xff\xc3\xa9\\u0085'");
  CHECK(trismooth::quoted(std::string(39, 'x') + "\xc3\xa9y") == "'" + std::string(39, 'x') + "\xc3\xa9...'");
  CHECK(trismooth::quoted(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
}

TEST_CASE("declared counts must fit into the file") {
  CHECK_NOTHROW(trismooth::require_room("f", "vertices", 10, 6, 60));
  CHECK(message_of<ReadError>([] { trismooth::require_room("f", "vertices", 11, 6, 65); }) ==
        "f: declares 11 vertices, but the file has room for 10 at most: it is cut off, or that number is wrong");
  CHECK_THROWS_AS(trismooth::require_room("f", "vertices", std::numeric_limits<std::uint64_t>::max(), 8, 1000),
                  ReadError);
}
