// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/shell_words.h"

#include <string>
#include <vector>

#include "catch.h"

namespace trismooth::shell_words_test {

TEST_CASE("what needs no quotes has none, and nothing that a terminal obeys is left") {
  CHECK(shell_command(std::vector<std::string>{"trismooth", "smooth", "--require", "inverted == 0", "it's"}) ==
        "trismooth smooth --require 'inverted == 0' 'it'\\''s'");
  CHECK(shell_word("\x1b[31m") == "$'\\033[31m'");
  CHECK(shell_word("a\nb'c") == "$'a\\012b\\'c'");
  CHECK(shell_word("\xff") == "$'\\377'");
  CHECK(shell_word("\xc2\x9b") == "$'\\302\\233'");
  CHECK(shell_word("\xc3\xb6") == "'\xc3\xb6'");
  CHECK(shell_word("\xe2\x82") == "$'\\342\\202'");
  CHECK(shell_word("\xed\xa0\x80") == "$'\\355\\240\\200'");
  CHECK(shell_word("\xc2\xa0") == "'\xc2\xa0'");
  CHECK(shell_word("\x7f") == "$'\\177'");
  CHECK(shell_word(std::string(1, '\0')) == "$'\\000'");
  CHECK(shell_word("\xe0\x9f\xbf") == "$'\\340\\237\\277'");
  CHECK(shell_word("\xf4\x90\x80\x80") == "$'\\364\\220\\200\\200'");
  CHECK(shell_word("\xf0\x9f\x98\x80\n") == "$'\xf0\x9f\x98\x80\\012'");
  for (const char* harmless : {"plain", "--form=a", "a/b-c_d.e:f,g@h%i+j", "inverted==0"}) {
    CHECK(shell_word(harmless) == harmless);
  }
  for (const char* quoted :
       {"", "a b", "$HOME", "`id`", "a\\b", "*", "=ls", "~", "a>b", "a;b", "#", "{a,b}", "!", "\""}) {
    CHECK(shell_word(quoted) == "'" + std::string(quoted) + "'");
  }
}

}  // namespace trismooth::shell_words_test
