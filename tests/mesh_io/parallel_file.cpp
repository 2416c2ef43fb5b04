// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/parallel_file.h"

#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"

#include "catch.h"
#include "support/says.h"

namespace trismooth::parallel_file_test {

std::string summary(const std::string& pieces, const std::string& type = "PUnstructuredGrid") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\">\n<" + type + " GhostLevel=\"1\">\n" + pieces + "</" +
         type + ">\n</VTKFile>\n";
}

ParallelFile read(const std::string& bytes) {
  return read_parallel_file("parts/big.pvtu", bytes);
}

/// What is said of a file that is refused; empty where it is not.
std::string refusal(const std::string& bytes) {
  try {
    read(bytes);
    return {};
  } catch (const ReadError& error) {
    return error.what();
  }
}

TEST_CASE("A parallel file names its pieces, and where they stand") {
  const std::string bytes =
      summary("<Piece Source=\"a.vtu\"/>\n<Piece Other=' Source=\"x\"' Source = 'sub/b&amp;c.vtu'></Piece>\n");
  const ParallelFile file = read(bytes);
  CHECK(file.piece_format == FileFormat::vtu);
  REQUIRE(file.pieces.size() == 2);
  CHECK(file.pieces[0].source == "a.vtu");
  CHECK(file.pieces[1].source == "sub/b&c.vtu");
  CHECK(bytes.substr(file.pieces[1].begin, file.pieces[1].end - file.pieces[1].begin) == "sub/b&amp;c.vtu");
  CHECK(trismooth::piece_path("parts/big.pvtu", file.pieces[1].source) == "parts/sub/b&c.vtu");
  CHECK(read_parallel_file("p.pvtp", summary("<Piece Source='a.vtp'/>", "PPolyData")).piece_format == FileFormat::vtp);
}

TEST_CASE("Other sources take the place of those of a parallel file, and nothing else changes") {
  const std::string bytes = summary("<Piece Source=\"a&amp;b.vtu\"/><!-- a.vtu -->\n<Piece Source='b.vtu' />\n");
  const ParallelFile file = read(bytes);
  CHECK(trismooth::with_sources(bytes, file, std::vector<std::string>{"a&b.vtu", "b.vtu"}) == bytes);
  CHECK(trismooth::with_sources(bytes, file, std::vector<std::string>{"o&_0.vtu", "long_name_1.vtu"}) ==
        summary("<Piece Source=\"o&amp;_0.vtu\"/><!-- a.vtu -->\n<Piece Source='long_name_1.vtu' />\n"));
}

TEST_CASE("Files that name no pieces, or the wrong ones, are refused with their line") {
  CHECK(says(refusal(summary("")), "big.pvtu:3: names no pieces"));
  CHECK(says(refusal(summary("<Piece/>")), "big.pvtu:4: a <Piece> names no file"));
  CHECK(says(refusal(summary("<Piece Source=''/>")), "names no file"));
  CHECK(says(refusal(summary("<Piece Source='../parts/big.pvtu'/>")), "names itself"));
  CHECK(says(refusal(summary("<Piece Source='a.vtu'/>\n<Piece Source='./x/../a.vtu'/>")),
             "big.pvtu:5: names the piece './x/../a.vtu' twice, in line 4"));
  CHECK(says(refusal(summary("", "PImageData")), "'PImageData'"));
  CHECK(says(refusal("<VTKFile type=\"PUnstructuredGrid\"></VTKFile>"), "has not the element"));
  CHECK(says(refusal("<html></html>"), "expected <VTKFile>"));
  CHECK(says(refusal(summary("<Piece").substr(0, 90)), "cut off"));
  CHECK(says(refusal(std::string("<\0V\0", 4)), "UTF-8"));
  CHECK(says(refusal(""), "cut off"));
}

TEST_CASE("Parallel files are known by their extension") {
  CHECK(trismooth::names_parallel_file("a/b.PVTU"));
  CHECK(trismooth::names_parallel_file("b.pvtp"));
  CHECK_FALSE(trismooth::names_parallel_file("b.vtu"));
  CHECK_FALSE(trismooth::names_parallel_file("pvtu"));
}

}  // namespace trismooth::parallel_file_test
