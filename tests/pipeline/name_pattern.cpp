// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/name_pattern.h"

#include <string>

#include "catch.h"

namespace trismooth::name_pattern_test {

TEST_CASE("a pattern without wildcards is the name itself") {
  CHECK(matches_pattern("depth", "depth"));
  CHECK_FALSE(matches_pattern("depth", "Depth"));
  CHECK_FALSE(matches_pattern("depth", "depths"));
  CHECK_FALSE(matches_pattern("depth", "dept"));
  CHECK_FALSE(matches_pattern("", "a"));
  CHECK(matches_pattern("", ""));
}

TEST_CASE("a star stands for any characters or none, a question mark for one") {
  CHECK(matches_pattern("*", ""));
  CHECK(matches_pattern("*", "water depth"));
  CHECK(matches_pattern("u*", "u"));
  CHECK(matches_pattern("*_old", "heat_old"));
  CHECK_FALSE(matches_pattern("*_old", "heat_older"));
  CHECK(matches_pattern("a*b*c", "abbc"));
  CHECK(matches_pattern("a*b*c", "a-b-b-c"));
  CHECK_FALSE(matches_pattern("a*b*c", "acb"));
  CHECK(matches_pattern("u?", "u1"));
  CHECK_FALSE(matches_pattern("u?", "u"));
  CHECK(matches_pattern("**?", "x"));
}

TEST_CASE("a backslash takes a wildcard as it is") {
  CHECK(matches_pattern(R"(5\*)", "5*"));
  CHECK_FALSE(matches_pattern(R"(5\*)", "5x"));
  CHECK(matches_pattern(R"(what\?*)", "what? this"));
  CHECK(matches_pattern(R"(a\\b)", R"(a\b)"));
  CHECK(matches_pattern("a\\", "a\\"));
}

TEST_CASE("names with wildcards are told from those without") {
  CHECK(is_wild("u*"));
  CHECK(is_wild("?"));
  CHECK_FALSE(is_wild("depth"));
  CHECK_FALSE(is_wild(R"(5\*)"));
  CHECK(is_wild(R"(5\\*)"));
}

TEST_CASE("many stars take no time") {
  std::string pattern;
  for (int i = 0; i < 200; ++i) {
    pattern += "a*";
  }
  CHECK_FALSE(matches_pattern(pattern + "b", std::string(5000, 'a')));
}

}  // namespace trismooth::name_pattern_test
