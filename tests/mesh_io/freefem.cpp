// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/scratch_folder.h"

namespace trismooth::freefem_test {

using byte_files::contains;

/// A square of two regions as savemesh() writes it.
const std::string halves =
    "5 4 4\n0 0 1\n1 0 2\n1 1 3\n0 1 4\n0.4 0.6 0\n1 2 5 0\n2 3 5 0\n3 4 5 1\n4 1 5 1\n1 2 1\n2 3 2\n3 4 3\n4 1 4\n";

std::vector<std::int32_t> labels_of(const std::vector<trismooth::DataArray>& arrays) {
  return byte_files::values<std::int32_t>(find_array(arrays, "freefem:label"));
}

std::string freefem_refusal(const std::string& text) {
  return byte_files::refusal(freefem_codec, text);
}

std::string as_freefem(const MeshDocument& document) {
  const ScratchFolder folder;
  freefem_codec.write(folder / "out", document);
  return bytes_of(folder / "out");
}

MeshDocument two_triangles(double z = 0) {
  MeshDocument document;
  document.points = {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z};
  document.cells.append(trismooth::cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  return document;
}

TEST_CASE("FreeFem: vertices, triangles, edges and their labels are read") {
  const MeshDocument document = freefem_codec.read("mesh.msh", halves);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.4, 0.6, 0});
  CHECK(document.cells.types == std::vector<std::uint8_t>{5, 5, 5, 5, 3, 3, 3, 3});
  CHECK(document.cells.connectivity ==
        std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 1, 1, 2, 2, 3, 3, 0});
  CHECK(labels_of(document.point_arrays) == std::vector<std::int32_t>{1, 2, 3, 4, 0});
  CHECK(labels_of(document.cell_arrays) == std::vector<std::int32_t>{0, 0, 1, 1, 1, 2, 3, 4});
  CHECK(trismooth::is_region_name("freefem:label"));
  CHECK(document.notes.empty());
  CHECK(byte_files::is_valid(document));
}

TEST_CASE("FreeFem: what breaks the rules is refused with the line and the reason") {
  struct Fault {
    std::string from, to, message;
  };
  for (const Fault& fault : {
           Fault{"5 4 4\n", "5 x 4\n", "mesh:1: expected the number of triangles (a whole number), got 'x'"},
           {"5 4 4\n", "-5 4 4\n", "mesh:1: expected the number of vertices from 0 to"},
           {"5 4 4\n", "5 400000 4\n", "declares 400000 triangles, but the file has room for"},
           {"0 1 4\n", "0 nan 4\n", "mesh:5: expected a coordinate (a finite number), got 'nan'"},
           {"0 1 4\n", "0 1 0.5\n", "mesh:5: expected a label (a whole number), got '0.5'"},
           {"2 3 5 0", "2 3 6 0",
            "mesh:8: triangle 2 of 4: expected a vertex number, got '6'; the file has 5 vertices"},
           {"4 1 4\n", "0 1 4\n", "mesh:14: edge 4 of 4: expected a vertex number, got '0'"},
           {"5 4 4\n", "5 4 3\n", "mesh:14: expected the end of the file after the declared 5 vertices, 4 triangles"},
           {"4 1 4\n", "4 1\n", "expected a label, got the end of the file"},
       }) {
    const std::string message = freefem_refusal(replace_all(halves, fault.from, fault.to));
    INFO(message << "\nexpected: " << fault.message);
    CHECK(contains(message, fault.message));
  }
}

TEST_CASE("FreeFem: its files are recognised, and no others of numbers alone") {
  const std::string long_file =
      "3000 1 1\n" + replace_all(std::string(3000, 'v'), "v", "0.125 0.25 0\n") + "1 2 3 0\n1 2 0\n";
  const std::string nodes = "3000 2000 0\n" + replace_all(std::string(3000, 'v'), "v", "0.125 0.25 0\n");
  const std::string no_edges = nodes + replace_all(std::string(1000, 't'), "t", "3 2 1 0\n7 8 3000 0\n");
  const std::string few_triangles = replace_all(nodes, "3000 2000", "3000 2") + "1 2 3 0\r\n3 2 4 0\r\n\x1a";
  for (const std::string& text : {halves, replace_all(halves, "\n", " \r\n"), "\xEF\xBB\xBF\n" + halves, long_file,
                                  no_edges, few_triangles, std::string("3 1 0\n0 0 1\n1 0 1\n0 1 1\n1 2 3 1\n")}) {
    CHECK(freefem_codec.recognises(text));
  }
  for (const std::string& text :
       {std::string(), std::string("$MeshFormat\n"), std::string("3 1 0\n"),
        std::string("3 0 3\n0 0 0\n1 0 0\n0 1 0\n"),
        // OFF without its keyword; TetGen's and Triangle's nodes.
        std::string("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), std::string("4 2 0 1\n1 0 0 1\n"),
        std::string("3 1 1\n1 0.5 0.5 1\n"), replace_all(long_file, "3000 1 1", "3000 1 0"),
        // A long file of OFF without its keyword, and one whose triangles have too large a number or too few.
        nodes + replace_all(std::string(1000, 't'), "t", "3 2 1 9\n3 8 2999 5\n"),
        nodes + replace_all(std::string(1000, 't'), "t", "3 2 1 0\n7 8 3001 0\n"),
        nodes + replace_all(std::string(1000, 't'), "t", "3 2 1 0\n7 8 0\n"), replace_all(halves, "1 2 5 0", "1 2 6 0"),
        replace_all(halves, "0 0 1\n", "0 0 1 2\n")}) {
    CAPTURE(text.substr(0, 40));
    CHECK_FALSE(freefem_codec.recognises(text));
  }
}

TEST_CASE("FreeFem: a mesh from elsewhere is written with its groups as labels and with the edges that it has") {
  MeshDocument document = two_triangles();
  CHECK(as_freefem(document) == "4 2 1\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 2 3 0\n1 3 4 0\n1 2 0\n");
  const std::string order = "FreeFem lists cells by their type: they are written in another order";
  CHECK(freefem_codec.what_is_lost(document) == std::vector<std::string>{order});
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::int16_t>{9, 5, 6}));
  document.point_arrays.push_back(make_data_array("marker", 1, std::vector<std::int64_t>{1, 2, 0, 0}));
  document.point_arrays.push_back(make_data_array("depth", 1, std::vector<double>{1, 2, 0, 0}));
  document.point_sets = {{"inlet", {0}}};
  document.cells.append(trismooth::cell_type::vertex, std::vector<std::int32_t>{0});
  document.cell_arrays[0] = make_data_array("region", 1, std::vector<std::int16_t>{9, 5, 6, 1});
  CHECK(as_freefem(document) == "4 2 1\n0 0 1\n1 0 2\n1 1 0\n0 1 0\n1 2 3 5\n1 3 4 6\n1 2 9\n");
  CHECK(freefem_codec.what_is_lost(document) ==
        std::vector<std::string>{"FreeFem holds triangles and edges only: 1 cell of type vertex is not written",
                                 "FreeFem holds no point arrays: depth is not written",
                                 "FreeFem holds no sets of points: inlet is not written", order});
}

TEST_CASE("FreeFem: z is lost where it is one number, and refused where it is not") {
  MeshDocument document = two_triangles(2.5);
  CHECK(contains(freefem_codec.what_is_lost(document).at(0), "z, 2.5, is not written"));
  CHECK(contains(as_freefem(document), "\n1 1 0\n"));
  document.points[2] = -2.5;
  CHECK_THROWS_AS(as_freefem(document), trismooth::WriteError);
}

}  // namespace trismooth::freefem_test
