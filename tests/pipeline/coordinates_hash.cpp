// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/coordinates_hash.h"

#include <array>
#include <vector>

#include "catch.h"

namespace trismooth::coordinates_hash_test {

// The expected values come from an implementation of XXH64 written from its specification, in another language.

TEST_CASE("the hash is XXH64 with seed 0 of the little-endian bytes") {
  CHECK(coordinates_hash({}) == 0xef46db3751d8e999U);
  CHECK(coordinates_hash(std::array{0.0, 0.0, 0.0}) == 0xbb3302e8a9608868U);
  CHECK(coordinates_hash(std::array{1.0, 2.0, 0.0}) == 0x37a407b8f288da3fU);
  std::vector<double> many;
  for (int i = 0; i < 3000; ++i) {
    many.push_back(static_cast<double>(i) * i - 0.5);
  }
  CHECK(coordinates_hash(many) == 0x1e187e5f62dcece3U);
}

TEST_CASE("the hash of a mesh in the plane is that with z = 0") {
  CHECK(trismooth::planar_coordinates_hash(std::array{1.0, 2.0}) == coordinates_hash(std::array{1.0, 2.0, 0.0}));
  CHECK(trismooth::planar_coordinates_hash(std::array{1.0, 2.0, -0.5, 4.0}) ==
        coordinates_hash(std::array{1.0, 2.0, 0.0, -0.5, 4.0, 0.0}));
}

TEST_CASE("the hash tells -0 from 0") {
  CHECK(coordinates_hash(std::array{1.0, 2.0, -0.0}) == 0xab1f266f2ef6da21U);
}

TEST_CASE("a hash is written with all its 16 digits") {
  CHECK(hash_text(0) == "0000000000000000");
  CHECK(hash_text(0xABCDEFU) == "0000000000abcdef");
  CHECK(hash_text(~std::uint64_t{0}) == "ffffffffffffffff");
}

}  // namespace trismooth::coordinates_hash_test
