#include "trismooth/mesh_io/document/coordinate_sites.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::CoordinateEncoding;
using trismooth::CoordinateSites;
using trismooth::FileWorkers;
using trismooth::ScalarType;
using trismooth::write_patched;

namespace {

std::string patched(const std::string& bytes, const CoordinateSites& sites, const std::vector<double>& points,
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
  CoordinateSites sites;
  sites.offsets = {2, 8, 13, 20, 23, 25};
  CHECK(patched(bytes, sites, {1, 2, 3, 4, 5, 6}) == bytes);
  CHECK(patched(bytes, sites, {1, 2, 0.1, 4, 5, 6}) == "v 1.000 +2e0\t0.1#c\nv 4\\\n5 6");
  CHECK(patched(bytes, sites, {-1.5, 2, 3, 1e300, 5, -0.25}) == "v -1.5 +2e0\t3.#c\nv 1e+300\\\n5 -0.25");
  CHECK(patched(bytes, sites, {1, 2, 3, 4, 5, 6}, "# end") == bytes + "# end");
}

TEST_CASE("the sign of a zero is written, so that what is read back has the bits of the mesh") {
  CoordinateSites sites;
  sites.offsets = {0, 6, 8};
  CHECK(patched("-0.00 0 +0", sites, {-0.0, 0.0, 0.0}) == "-0.00 0 +0");
  CHECK(patched("-0.00 0 +0", sites, {0.0, -0.0, 0.0}) == "0 -0 +0");
}

TEST_CASE("sites of one vertex may differ in the sign of a zero, as corners of STL that were found equal") {
  CoordinateSites sites;
  sites.offsets = {0, 2, 4, 6, 9, 11};
  sites.vertices = {0, 0};
  CHECK(patched("0 5 5 -0 5 5", sites, {0.0, 5, 5}) == "0 5 5 -0 5 5");
  CHECK(patched("0 5 5 -0 5 5", sites, {0.0, 6, 5}) == "0 6 5 -0 6 5");
}

TEST_CASE("text of float32 files gets the shortest float32 text") {
  CoordinateSites sites;
  sites.type = ScalarType::float32;
  sites.offsets = {0, 4, 8};
  const double tenth = 0.1F;
  CHECK(patched("0.1 0.1 9.0", sites, {tenth, tenth, tenth}) == "0.1 0.1 0.1");
}

TEST_CASE("axes may stand in any order") {
  CoordinateSites sites;
  sites.offsets = {4, 2, 0};  // z y x
  CHECK(patched("3 2 1", sites, {10, 20, 30}) == "30 20 10");
}

TEST_CASE("a vertex may stand at several sites, as in STL") {
  CoordinateSites sites;
  sites.offsets = {0, 2, 4, 6, 8, 10, 12, 14, 16};
  sites.vertices = {1, 0, 1};
  CHECK(patched("1 1 1 0 0 0 1 1 1", sites, {0, 0, 7, 1, 5, 1}) == "1 5 1 0 0 7 1 5 1");
}

TEST_CASE("binary coordinates keep their width and byte order") {
  const bool big = GENERATE(false, true);
  CoordinateSites sites;
  sites.encoding = big ? CoordinateEncoding::big_endian : CoordinateEncoding::little_endian;
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

TEST_CASE("a place that cannot be written is named") {
  const ScratchFolder folder;
  trismooth::Workers alone(1);
  const std::string message = message_of<trismooth::WriteError>(
      [&] { write_patched(folder / "none/out", "0 0 0", {}, {}, {}, FileWorkers(alone)); });
  CHECK(message.find((folder / "none/out").string()) == 0);
  if (std::filesystem::exists("/dev/full")) {
    CHECK_THROWS_AS(write_patched("/dev/full", "0 0 0", {}, {}, {}, FileWorkers(alone)), trismooth::WriteError);
  }
}
