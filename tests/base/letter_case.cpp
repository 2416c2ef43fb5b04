// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/text/letter_case.h"

#include "catch.h"

namespace trismooth::letter_case_test {

TEST_CASE("the letters of ASCII change their case, and nothing else does") {
  CHECK(lower_case("AbZ-09 [\xC3\x84") == "abz-09 [\xC3\x84");
  CHECK(upper_case("aBz-09 {\xC3\xA4") == "ABZ-09 {\xC3\xA4");
  for (int c = 0; c < 256; ++c) {
    const char letter = static_cast<char>(c);
    CHECK(upper_letter(lower_letter(letter)) == upper_letter(letter));
    CHECK(lower_letter(upper_letter(letter)) == lower_letter(letter));
  }
}

TEST_CASE("texts with the same letters are the same but for their case") {
  CHECK(same_letters("su2", "SU2"));
  CHECK(same_letters("", ""));
  CHECK_FALSE(same_letters("su2", "su"));
  CHECK_FALSE(same_letters("@", "`"));  // a bit apart, as letters are
}

}  // namespace trismooth::letter_case_test
