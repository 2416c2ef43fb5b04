// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/free_names.h"

#include <set>
#include <string>
#include <vector>

#include "catch.h"
#include "support/test_meshes.h"

using trismooth::FreeNames;

TEST_CASE("a name that is free stays, one that is taken gets the first number that makes it free") {
  FreeNames names;
  names.take("b");
  names.take("b");
  names.take("a_2");
  CHECK(names.claim("a") == "a");
  CHECK(names.claim("a") == "a_1");
  CHECK(names.claim("a") == "a_3");
  CHECK(names.claim("b") == "b_1");
  CHECK(names.claim("a_1") == "a_1_1");
  CHECK(names.claim("") == "");
  CHECK(names.claim("") == "_1");
  CHECK(names.claim("_1") == "_1_1");
}

TEST_CASE("every name gets the first free number, whatever was wanted before") {
  test_meshes::Random random(1);
  FreeNames names;
  std::set<std::string> taken;
  for (int i = 0; i < 500; ++i) {
    // Names that are like the ones made of others.
    std::string wanted(1, static_cast<char>('a' + random.below(2)));
    for (int part = random.below(3); part > 0; --part) {
      wanted += "_" + std::to_string(1 + random.below(9));
    }
    std::string expected = wanted;
    for (int number = 1; taken.contains(expected); ++number) {
      expected = wanted + "_" + std::to_string(number);
    }
    taken.insert(expected);
    REQUIRE(names.claim(wanted) == expected);
  }
}
