// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/number_sites.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/document/patched_original.h"
#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::FileWorkers;
using trismooth::NumberEncoding;
using trismooth::NumberSites;
using trismooth::ScalarType;
using trismooth::write_patched;

namespace {

std::string patched(const std::string& bytes, const NumberSites& sites, const std::vector<double>& points,
                    std::string_view suffix = {}) {
  const ScratchFolder folder;
  trismooth::Workers alone(1);
  write_patched(folder / "out", bytes, sites, points, suffix, FileWorkers(alone));
  std::string whole = bytes_of(folder / "out");
  trismooth::Workers two(2);
  for (const std::size_t part_bytes : {1, 40, 100}) {
    write_patched(folder / "parts", bytes, sites, points, suffix, FileWorkers(two, part_bytes));
    CHECK(bytes_of(folder / "parts") == whole);
  }
  return whole;
}

/// The bytes of a number, most significant first where `big` is set; by shifts, on any machine.
template <class T, class Bits>
std::string encoded(T value, bool big) {
  const auto bits = std::bit_cast<Bits>(value);
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  }
  if (big) {
    std::ranges::reverse(bytes);
  }
  return bytes;
}

}  // namespace

TEST_CASE("only text that states another value is replaced") {
  const std::string bytes = "v 1.000 +2e0\t3.#c\nv 4\\\n5 6";
  NumberSites sites;
  sites.offsets = {2, 8, 13, 20, 23, 25};
  CHECK(patched(bytes, sites, {1, 2, 3, 4, 5, 6}) == bytes);
  CHECK(patched(bytes, sites, {1, 2, 0.1, 4, 5, 6}) == "v 1.000 +2e0\t0.1#c\nv 4\\\n5 6");
  CHECK(patched(bytes, sites, {-1.5, 2, 3, 1e300, 5, -0.25}) == "v -1.5 +2e0\t3.#c\nv 1e+300\\\n5 -0.25");
  CHECK(patched(bytes, sites, {1, 2, 3, 4, 5, 6}, "# end") == bytes + "# end");
}

TEST_CASE("the sign of a zero is written, so that what is read back has the bits of the mesh") {
  NumberSites sites;
  sites.offsets = {0, 6, 8};
  CHECK(patched("-0.00 0 +0", sites, {-0.0, 0.0, 0.0}) == "-0.00 0 +0");
  CHECK(patched("-0.00 0 +0", sites, {0.0, -0.0, 0.0}) == "0 -0 +0");
}

TEST_CASE("sites of one vertex may differ in the sign of a zero, as corners of STL that were found equal") {
  NumberSites sites;
  sites.offsets = {0, 2, 4, 6, 9, 11};
  sites.vertices = {0, 0};
  CHECK(patched("0 5 5 -0 5 5", sites, {0.0, 5, 5}) == "0 5 5 -0 5 5");
  CHECK(patched("0 5 5 -0 5 5", sites, {0.0, 6, 5}) == "0 6 5 -0 6 5");
}

TEST_CASE("text of float32 files gets the shortest float32 text") {
  NumberSites sites;
  sites.type = ScalarType::float32;
  sites.offsets = {0, 4, 8};
  const double tenth = 0.1F;
  CHECK(patched("0.1 0.1 9.0", sites, {tenth, tenth, tenth}) == "0.1 0.1 0.1");
}

TEST_CASE("axes may stand in any order") {
  NumberSites sites;
  sites.offsets = {4, 2, 0};  // z y x
  CHECK(patched("3 2 1", sites, {10, 20, 30}) == "30 20 10");
}

TEST_CASE("a vertex may stand at several sites, as in STL") {
  NumberSites sites;
  sites.offsets = {0, 2, 4, 6, 8, 10, 12, 14, 16};
  sites.vertices = {1, 0, 1};
  CHECK(patched("1 1 1 0 0 0 1 1 1", sites, {0, 0, 7, 1, 5, 1}) == "1 5 1 0 0 7 1 5 1");
}

TEST_CASE("binary coordinates keep their width and byte order") {
  const bool big = GENERATE(false, true);
  NumberSites sites;
  sites.encoding = big ? NumberEncoding::big_endian : NumberEncoding::little_endian;
  SECTION("float64") {
    sites.offsets = {3, 11, 20};
    const auto file = [&](double x, double y, double z) {
      return "abc" + encoded<double, std::uint64_t>(x, big) + encoded<double, std::uint64_t>(y, big) + "-" +
             encoded<double, std::uint64_t>(z, big) + "end";
    };
    CHECK(patched(file(1, 2, 3), sites, {1, 2, 3}) == file(1, 2, 3));
    CHECK(patched(file(1, 2, 3), sites, {0.1, 2, -1e-300}) == file(0.1, 2, -1e-300));
  }
  SECTION("float32") {
    sites.type = ScalarType::float32;
    sites.offsets = {0, 4, 8};
    const auto file = [&](float x, float y, float z) {
      return encoded<float, std::uint32_t>(x, big) + encoded<float, std::uint32_t>(y, big) +
             encoded<float, std::uint32_t>(z, big);
    };
    CHECK(patched(file(1.5F, 2, 3), sites, {1.5, 2, 0.1F}) == file(1.5F, 2, 0.1F));
  }
}

TEST_CASE("a flat file states no z, and none is written") {
  NumberSites sites;
  sites.columns = {{.component = 0}, {.component = 1}};
  sites.offsets = {2, 4, 8, 10};
  CHECK(patched("1 5 6\n2 7 8", sites, {5, 6, 0, 7, 8, 0}) == "1 5 6\n2 7 8");
  CHECK(patched("1 5 6\n2 7 8", sites, {5, 0.5, 0, -7, 8, 0}) == "1 5 0.5\n2 -7 8");
}

TEST_CASE("exponents of Fortran and Nastran are understood where they stand") {
  NumberSites sites;
  sites.columns = {{.component = 0}, {.component = 1}};
  sites.offsets = {0, 8, 16, 24};
  const std::string bytes = "1.50D+00,-2.5d-01,15.0-1  +2.5+2";
  sites.offsets = {0, 9, 18, 26};
  CHECK(patched(bytes, sites, {1.5, -0.25, 0, 1.5, 250, 0}) == bytes);
  CHECK(patched(bytes, sites, {1.5, 0.25, 0, 2, 250, 0}) == "1.50D+00,0.25,2  +2.5+2");
}

TEST_CASE("a number as text takes the characters that the file has for it") {
  NumberSites sites;
  sites.columns = {{.component = 0}, {.component = 1}};
  sites.offsets = {0, 2};
  sites.most_characters = 10;
  CHECK(patched("0 0", sites, {1.0 / 3, -2e-7 / 3, 0}) == "0.33333333 -6.667e-08");
  CHECK(patched("0 0", sites, {123456789012, -1.5, 0}) == "1.2346e+11 -1.5");
}

TEST_CASE("values of point arrays stand beside coordinates or in lists behind them") {
  const std::string bytes = "1 2 30\n3 4 40\n$data\n7 0.1\n8 0.2\n";
  NumberSites nodes;
  nodes.columns = {{.component = 0}, {.component = 1}, {.array = "depth"}};
  nodes.offsets = {0, 2, 4, 7, 9, 11};
  NumberSites data;
  data.columns = {{.array = "heat"}};
  data.offsets = {22, 28};
  trismooth::MeshDocument document;
  document.points = {1, 2, 0, 3, 4, 0};
  const auto original = trismooth::make_patched_original(bytes, std::vector{nodes, data});
  const auto written = [&] {
    const ScratchFolder folder;
    original->write(folder / "out", document, {}, {});
    return bytes_of(folder / "out");
  };
  CHECK(written() == bytes);
  CHECK(original->keeps_values_of("depth"));
  CHECK(original->keeps_values_of("heat"));
  CHECK_FALSE(original->keeps_values_of("Heat"));
  document.point_arrays.push_back(trismooth::make_data_array("heat", 1, std::vector<double>{0.1, 0.25}));
  document.point_arrays.push_back(trismooth::make_data_array("depth", 1, std::vector<float>{30, 41.5F}));
  document.points[0] = -1;
  CHECK(written() == "-1 2 30\n3 4 41.5\n$data\n7 0.1\n8 0.25\n");
}

TEST_CASE("a place that cannot be written is named") {
  const ScratchFolder folder;
  trismooth::Workers alone(1);
  const std::string message = message_of<trismooth::WriteError>([&] {
    write_patched(folder / "none/out", "0 0 0", NumberSites(), std::vector<double>(), {}, FileWorkers(alone));
  });
  CHECK(message.find((folder / "none/out").string()) == 0);
  if (std::filesystem::exists("/dev/full")) {
    CHECK_THROWS_AS(write_patched("/dev/full", "0 0 0", NumberSites(), std::vector<double>(), {}, FileWorkers(alone)),
                    trismooth::WriteError);
  }
}
