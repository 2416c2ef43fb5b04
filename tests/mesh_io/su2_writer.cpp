// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/su2/su2_writer.h"

#include <memory>
#include <string>
#include <vector>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/scratch_folder.h"

using trismooth::ArrayDescription;
using trismooth::FileFormat;
using trismooth::MeshDocument;
using trismooth::ValueName;
using trismooth::what_is_lost;
using trismooth::write_mesh;
using trismooth::WriteError;

namespace type = trismooth::cell_type;

namespace {

/// Two triangles, the square's lower and right side as lines, the diagonal as another.
MeshDocument marked_square() {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 0.1, 0, 0, 1, 0};
  const std::vector<std::vector<std::int32_t>> cells{{0, 1}, {1, 2}, {0, 2}, {0, 1, 2}, {0, 2, 3}};
  for (const auto& cell : cells) {
    document.cells.append(cell.size() == 2 ? type::line : type::triangle, cell);
  }
  return document;
}

void add_line_groups(MeshDocument& document, const std::vector<std::int32_t>& values,
                     const std::vector<ValueName>& names) {
  trismooth::DataArray array = trismooth::make_data_array("gmsh:physical", 1, values);
  const auto description = std::make_shared<ArrayDescription>();
  description->value_names = names;
  array.description = description;
  document.cell_arrays.push_back(std::move(array));
}

std::string su2_output(const MeshDocument& document) {
  const ScratchFolder folder;
  write_mesh(folder / "out.su2", document);
  return bytes_of(folder / "out.su2");
}

const std::string square_part = "NDIME= 2\nNPOIN= 4\n0 0\n1 0\n1 0.1\n0 1\nNELEM= 2\n5 0 1 2\n5 0 2 3\n";

}  // namespace

TEST_CASE("SU2 output: groups of lines are markers by their names, or by their numbers") {
  MeshDocument document = marked_square();
  add_line_groups(document, {7, 3, 0, 1, 2}, {{7, 1, "wall"}});
  CHECK(su2_output(document) ==
        square_part +
            "NMARK= 3\nMARKER_TAG= marker_3\nMARKER_ELEMS= 1\n3 1 2\nMARKER_TAG= wall\n"
            "MARKER_ELEMS= 1\n3 0 1\nMARKER_TAG= boundary\nMARKER_ELEMS= 3\n3 0 2\n3 2 3\n3 3 0\n");
  CHECK(what_is_lost(document, FileFormat::su2) ==
        std::vector<std::string>{
            "SU2 holds groups of lines only, as markers: what gmsh:physical says of other cells is not written",
            "SU2 needs markers: the 2 edges with one element and no line are written as the marker boundary"});
}

TEST_CASE("SU2 output: a mesh without lines gets its boundary as a marker") {
  MeshDocument document = marked_square();
  document.cells = {};
  for (const std::vector<std::int32_t>& cell : {std::vector{0, 1, 2}, std::vector{0, 2, 3}}) {
    document.cells.append(type::triangle, cell);
  }
  CHECK(su2_output(document) ==
        square_part + "NMARK= 1\nMARKER_TAG= boundary\nMARKER_ELEMS= 4\n3 0 1\n3 1 2\n3 2 3\n3 3 0\n");
  CHECK(what_is_lost(document, FileFormat::su2) ==
        std::vector<std::string>{
            "SU2 needs markers: the 4 edges with one element and no line are written as the marker boundary"});
}

TEST_CASE("SU2 output: names that SU2 would read otherwise are changed, and that is said") {
  MeshDocument document = marked_square();
  document.cells.append(type::line, std::vector{2, 3});
  document.cells.append(type::line, std::vector{3, 0});
  add_line_groups(document, {1, 2, 3, 0, 0, 4, 5},
                  {{1, 1, "the wall"}, {2, 1, "the_wall"}, {3, 1, "50%"}, {4, 1, "inlet"}, {5, 1, "inlet"}});
  const std::string text = su2_output(document);
  for (const std::string name : {"the_wall_1", "the_wall", "50_", "inlet", "inlet_1"}) {
    CAPTURE(text, name);
    CHECK(text.find("MARKER_TAG= " + name + "\n") != std::string::npos);
  }
  CHECK(
      what_is_lost(document, FileFormat::su2) ==
      std::vector<std::string>{"SU2 takes names without blanks and '%', each once: 'the wall' is the_wall_1, '50%' is "
                               "50_, 'inlet' is inlet_1"});
}

TEST_CASE("SU2 output: z is never dropped without a word") {
  MeshDocument document = marked_square();
  for (std::size_t i = 2; i < document.points.size(); i += 3) {
    document.points[i] = 4;
  }
  CHECK(what_is_lost(document, FileFormat::su2).front() == "SU2 holds x and y only: z, 4, is not written");
  CHECK(su2_output(document).starts_with(square_part));
  document.points[2] = 5;
  CHECK_THROWS_AS(su2_output(document), WriteError);
}

TEST_CASE("SU2 output: other cells, arrays and sets are named as lost") {
  MeshDocument document = marked_square();
  document.cells.append(type::vertex, std::vector{1});
  document.cells.append(type::polygon, std::vector{0, 1, 2, 3, 1});
  document.point_arrays.push_back(trismooth::make_data_array("depth", 1, std::vector<double>(4)));
  document.point_sets.push_back({"inlet", {0, 1}});
  CHECK(what_is_lost(document, FileFormat::su2) ==
        std::vector<std::string>{
            "SU2 holds triangles, quads and lines only: 1 cell of type vertex, 1 cell of type polygon are not written",
            "SU2 holds no point arrays: depth is not written", "SU2 holds no sets of points: inlet is not written",
            "SU2 needs markers: the 2 edges with one element and no line are written as the marker boundary"});
}

TEST_CASE("SU2 output: a mesh of nothing is one") {
  CHECK(su2_output(MeshDocument{}) == "NDIME= 2\nNPOIN= 0\nNELEM= 0\nNMARK= 0\n");
}
