// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "mesh_io/text_template.h"
#include "support/says.h"
#include "support/scratch_folder.h"
#include "support/text_format.h"

namespace trismooth::inp_test {

const TextFormat inp(".inp");

/// A square of two triangles and a node in no element, as a deck of CalculiX.
const std::string square =
    "** made by hand\n*HEADING\nMy *model, with commas\n*NODE, NSET=Nall\n1, 0., 0.\n2, 1., 0.\n30, 1., 1.\n4, 0., "
    "1.D0\n"
    "*ELEMENT, TYPE=CPS3, ELSET=steel\n1, 1, 2, 30\n*ELEMENT, TYPE=CPE3, ELSET=Copper\n7, 1, 30, 4\n"
    "*MATERIAL, NAME=m\n*ELASTIC\n210000., .3\n*STEP\n*STATIC\n*END STEP\n";

std::vector<ValueName> region_names(const MeshDocument& document) {
  return find_array(document.cell_arrays, "abaqus:elset")->description->value_names;
}

std::vector<std::int32_t> vertices(const MeshDocument& document, std::size_t cell) {
  const auto all = document.cells[cell];
  return {all.begin(), all.end()};
}

TEST_CASE("a deck's nodes, elements, sets and names are read in its order") {
  const MeshDocument document = inp.read(square);
  CHECK(document.format == FileFormat::inp);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::triangle});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "abaqus:elset") == std::vector<std::int32_t>{1, 2});
  CHECK(region_names(document) == std::vector<ValueName>{{1, 2, "steel"}, {2, 2, "Copper"}});
  CHECK(document.point_sets == std::vector<NamedSet>{{"Nall", {0, 1, 2, 3}}});
  CHECK(document.cell_sets.empty());
  CHECK(document.notes.empty());
  CHECK(document.most_coordinate_characters == 20);
}

TEST_CASE("new numbers take 20 characters at most") {
  MeshDocument document = inp.read(square);
  document.points[6] = -1.2345678901234567e-5;
  const std::string text = inp.written(document);
  CHECK(says(text, "30, -1.2345678901235e-05, 1."));
  CHECK(text.size() == square.size() + 18);
}

TEST_CASE("coordinates that a node line leaves out are 0, and stand there once they are not") {
  MeshDocument document = inp.read("*NODE\n1\n2, 2.\n3, , 3.\n4, 4., , 5.\n5,,,\n6, 1., 2., 3., 0., 0., 1.\n");
  CHECK(document.points == std::vector<double>{0, 0, 0, 2, 0, 0, 0, 3, 0, 4, 0, 5, 0, 0, 0, 1, 2, 3});
  for (double& coordinate : document.points) {
    coordinate += 10;
  }
  CHECK(inp.written(document) ==
        "*NODE\n1, 10, 10, 10\n2, 12, 10, 10\n3, 10, 13, 10\n4, 14, 10, 15\n5,10,10,10\n6, 11, 12, 13, 0., 0., 1.\n");
  MeshDocument one = inp.read("*NODE\n1\n2, 1.\n3, 2.\n");
  one.points[4] = 0.5;
  CHECK(inp.written(one) == "*NODE\n1\n2, 1., 0.5\n3, 2.\n");
}

TEST_CASE("keywords are read whatever their case, blanks and line breaks") {
  const MeshDocument document = inp.read(
      "*Node ,\n nset = \"my nodes\"\n 1 ,0,0\n** a comment\n\n\t2, 1 , 0\n3,0,1\n*element,\ntype = s3r , \n"
      "elset=E 1\n 5,\n1,2,\n3\n*NODE FILE\nU\n*node print, nset=x\nU\n*EL FILE\nS\n");
  CHECK(document.point_count() == 3);
  CHECK(vertices(document, 0) == std::vector<std::int32_t>{0, 1, 2});
  CHECK(document.point_sets == std::vector<NamedSet>{{"my nodes", {0, 1, 2}}});
  CHECK(region_names(document).front().name == "E1");
}

TEST_CASE("elements of all families are cells of their shape") {
  const std::string nodes = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,.5,0\n6,1,.5\n7,.5,1\n8,0,.5\n9,.5,.5\n";
  const auto type_of = [&](const std::string& type, int count) {
    std::string line = "1";
    for (int i = 1; i <= count; ++i) {
      line += ", " + std::to_string(i);
    }
    CAPTURE(type);
    const MeshDocument document = inp.read(nodes + "*ELEMENT, TYPE=" + type + "\n" + line + "\n");
    CHECK(document.notes.empty());
    return document.cells.types.at(0);
  };
  for (const char* type : {"CPS3", "CPE3", "CPE3T", "CPEG3", "CAX3", "CGAX3H", "S3", "S3R", "S3RT", "STRI3", "M3D3",
                           "DC2D3", "DCAX3", "AC2D3", "ACAX3", "SFM3D3", "R3D3", "cps3", "DS3"}) {
    CHECK(type_of(type, 3) == cell_type::triangle);
  }
  for (const char* type : {"CPS6", "CPS6M", "CPE6MH", "CAX6", "STRI65", "M3D6", "DC2D6", "S6", "AC2D6"}) {
    CHECK(type_of(type, 6) == cell_type::quadratic_triangle);
  }
  for (const char* type : {"CPS4", "CPS4R", "CPE4RH", "CPEG4I", "CAX4RT", "S4", "S4R5", "M3D4R", "DC2D4", "R3D4"}) {
    CHECK(type_of(type, 4) == cell_type::quad);
  }
  for (const char* type : {"CPS8", "CPS8R", "CAX8", "S8R", "S8R5", "M3D8R", "DC2D8"}) {
    CHECK(type_of(type, 8) == cell_type::quadratic_quad);
  }
  CHECK(type_of("S9R5", 9) == cell_type::biquadratic_quad);
  for (const char* type : {"T2D2", "T3D2H", "B21", "B31", "B33", "B23H", "R2D2", "RAX2", "SAX1", "DC1D2", "SPRINGA"}) {
    CHECK(type_of(type, 2) == cell_type::line);
  }
  for (const char* type : {"T3D3", "B22", "B32", "SAX2", "DC1D3", "PIPE22"}) {
    CHECK(type_of(type, 3) == cell_type::quadratic_edge);
  }
  CHECK(type_of("MASS", 1) == cell_type::vertex);
  CHECK(type_of("C3D4", 4) == cell_type::tetrahedron);
  CHECK(type_of("C3D8R", 8) == cell_type::hexahedron);
  CHECK(type_of("SC6R", 6) == cell_type::wedge);
}

TEST_CASE("the middle node of a curve stands between its ends in the file, behind them in the document") {
  const std::string text = "*NODE\n1,0,0\n2,1,0\n3,2,0\n*ELEMENT, TYPE=T3D3\n1, 1, 2, 3\n";
  const MeshDocument document = inp.read(text);
  CHECK(vertices(document, 0) == std::vector<std::int32_t>{0, 2, 1});
  MeshDocument other = document;
  other.original = nullptr;
  CHECK(says(inp.written(other), "*ELEMENT, TYPE=T3D3\n1, 1, 2, 3\n"));
}

TEST_CASE("B33H has two nodes, and three as meshio writes it") {
  const MeshDocument document = inp.read("*NODE\n1,0,0\n2,1,0\n3,2,0\n*ELEMENT, TYPE=B33H\n1, 1, 3, 2\n2, 1, 3\n");
  CHECK(vertices(document, 0) == std::vector<std::int32_t>{0, 2, 1});
  CHECK(vertices(document, 1) == std::vector<std::int32_t>{0, 2});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "'B33H'"));
}

TEST_CASE("elements of types that are not known keep their nodes, and a note says so") {
  const MeshDocument document = inp.read(
      "*USER ELEMENT, NODES=3, TYPE=U7\n1,2\n*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=XYZ\n1, 1, 2,\n3\n2, 3\n"
      "*ELEMENT, TYPE=U7\n3, 1, 2, 3\n");
  CHECK(document.cells.types == std::vector<std::uint8_t>(3, cell_type::poly_vertex));
  CHECK(document.cells.offsets == std::vector<std::int64_t>{0, 3, 4, 7});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "'U7', 'XYZ'"));
}

TEST_CASE("sets are ranges, lists and other sets") {
  const MeshDocument document =
      inp.read(square +
               "*NSET, NSET=a, GENERATE\n1, 40, 1\n2, 30, 2\n*NSET, NSET=b\n4, A,\n 1\n"
               "*NSET, NSET=c, ELSET=STEEL\n*ELSET, ELSET=d\nsteel, copper\n*ELSET, ELSET=e\n7\n");
  REQUIRE(document.point_sets.size() == 4);
  CHECK(document.point_sets[1] == NamedSet{"a", {0, 1, 2, 3, 1, 2, 3}});
  CHECK(document.point_sets[2] == NamedSet{"b", {3, 0, 0, 1, 2, 3, 1, 2, 3}});
  CHECK(document.point_sets[3] == NamedSet{"c", {0, 1, 2}});
  CHECK(document.cell_sets == std::vector<NamedSet>{{"d", {0, 1}}, {"e", {1}}});
}

TEST_CASE("members that are not there are told of once, and stay in the file") {
  const std::string text = square + "*NSET, NSET=a\n1, 99, nobody\n";
  const MeshDocument document = inp.read(text);
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "sets name 2 nodes, elements or other sets that are not there"));
  CHECK(inp.written(document) == text);
}

TEST_CASE("sections say what the regions are, before names of elements, before sets that do not overlap") {
  const std::string mesh =
      "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT, TYPE=CPS3@\n1,1,2,3\n2,1,3,4\n*ELSET, ELSET=left\n1\n"
      "*ELSET, ELSET=right\n2\n*ELSET, ELSET=both\n1,2\n";
  const MeshDocument by_sets = inp.read(fill(mesh, {""}));
  CHECK(region_names(by_sets) == std::vector<ValueName>{{1, 2, "left"}, {2, 2, "right"}});
  CHECK(by_sets.cell_sets == std::vector<NamedSet>{{"both", {0, 1}}});
  const MeshDocument one_name = inp.read(fill(mesh, {", ELSET=all"}));
  CHECK(region_names(one_name) == std::vector<ValueName>{{1, 2, "left"}, {2, 2, "right"}});
  const MeshDocument by_sections =
      inp.read(fill(mesh, {", ELSET=all"}) + "*SOLID SECTION, ELSET=BOTH, MATERIAL=m\n1.\n");
  CHECK(values_of<std::int32_t>(by_sections.cell_arrays, "abaqus:elset") == std::vector<std::int32_t>{1, 1});
  CHECK(region_names(by_sections) == std::vector<ValueName>{{1, 2, "both"}});
  CHECK(by_sections.cell_sets.size() == 3);
  const MeshDocument shells =
      inp.read(fill(mesh, {""}) + "*Shell Section, elset=Right, material=m\n1.\n*Membrane Section, elset=left\n1.\n");
  CHECK(values_of<std::int32_t>(shells.cell_arrays, "abaqus:elset") == std::vector<std::int32_t>{2, 1});
}

TEST_CASE("a set that is made of others takes no region away, and one that cuts others is none") {
  const std::string mesh =
      "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,2,0\n*ELEMENT, TYPE=CPS3\n1,1,2,3\n2,1,3,4\n3,2,5,3\n"
      "*ELEMENT, TYPE=T3D2\n4,1,2\n5,2,5\n";
  const MeshDocument nested = inp.read(mesh +
                                       "*ELSET, ELSET=faces\n1,2,3\n*ELSET, ELSET=left\n1\n*ELSET, ELSET=middle\n"
                                       "3\n*ELSET, ELSET=pair\n1,2\n");
  CHECK(values_of<std::int32_t>(nested.cell_arrays, "abaqus:elset") == std::vector<std::int32_t>{2, 4, 3, 0, 0});
  CHECK(region_names(nested) == std::vector<ValueName>{{2, 2, "left"}, {3, 2, "middle"}, {4, 2, "pair"}});
  CHECK(nested.cell_sets == std::vector<NamedSet>{{"faces", {0, 1, 2}}, {"pair", {0, 1}}});
  const MeshDocument cut =
      inp.read(mesh + "*ELSET, ELSET=a\n1,2\n*ELSET, ELSET=b\n2,3\n*ELSET, ELSET=line\n4,4\n*ELSET, ELSET=c\n3,4\n");
  CHECK(region_names(cut) == std::vector<ValueName>{{1, 1, "line"}});
  CHECK(cut.cell_sets.size() == 3);
}

TEST_CASE("nodes that conditions, loads and constraints name by number are sets, which hold them") {
  const MeshDocument document = inp.read(square +
                                         "*BOUNDARY\n1, 1, 2\nNall, 3\n*CLOAD\n30, 2, -5.\n*EQUATION\n2\n4,1,1.,2,"
                                         "1,-1.\n*MPC\nBEAM, 2, 4\n");
  CHECK(document.point_sets ==
        std::vector<NamedSet>{
            {"Nall", {0, 1, 2, 3}}, {"*BOUNDARY", {0}}, {"*CLOAD", {2}}, {"*EQUATION", {3, 1}}, {"*MPC", {1, 3}}});
}

TEST_CASE("parts, instances and the assembly have labels and names of their own") {
  const std::string text =
      "*Heading\n*Part, name=Plate\n*Node\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*Element, type=CPS3\n1, 1, 2, 3\n"
      "*Nset, nset=Set-1\n2\n*Elset, elset=Set-1, generate\n1, 1, 1\n*Solid Section, elset=Set-1, material=m\n,\n"
      "*End Part\n*Part, name=Empty\n*End Part\n*Assembly, name=Assembly\n*Instance, name=Plate-1, part=Plate\n"
      "2., 0., 0.\n2., 0., 0., 2., 0., 1., 90.\n*End Instance\n*Instance, name=\"Own mesh\", part=Empty\n*Node\n"
      "1, 5., 5.\n2, 6., 5.\n3, 5., 6.\n*Element, type=CPS3\n1, 1, 2, 3\n*Elset, elset=Set-1\n1\n"
      "*Solid Section, elset=Set-1, material=m\n,\n*End Instance\n*Node\n1, 9., 9.\n"
      "*Element, type=CONN2D2\n1, Plate-1.2, 1\n*Nset, nset=ref\n1\n*Nset, nset=_Picked, internal, instance=Plate-1\n"
      "1, 3\n*Nset, nset=many\nPlate-1.Set-1, Plate-1.3, \"Own mesh\".2\n*End Assembly\n";
  MeshDocument document = inp.read(text);
  CHECK(document.notes.empty());
  CHECK(document.point_count() == 7);
  CHECK(vertices(document, 0) == std::vector<std::int32_t>{0, 1, 2});
  CHECK(vertices(document, 1) == std::vector<std::int32_t>{3, 4, 5});
  CHECK(vertices(document, 2) == std::vector<std::int32_t>{1, 6});
  CHECK(region_names(document) == std::vector<ValueName>{{1, 2, "Plate.Set-1"}, {2, 2, "Own mesh.Set-1"}});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "abaqus:elset") == std::vector<std::int32_t>{1, 2, 0});
  CHECK(document.point_sets ==
        std::vector<NamedSet>{{"Set-1", {1}}, {"ref", {6}}, {"_Picked", {0, 2}}, {"many", {1, 2, 4}}});
  CHECK(inp.written(document) == text);
}

TEST_CASE("included files are read, and stand in the place of their line once their nodes move") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string main =
      "*HEADING\r\n*NODE\r\n1, 0., 0.\r\n*Include, input=sub/nodes.dat\r\n9, 3., 3.\r\n*ELEMENT, TYPE=CPS3, "
      "INPUT=\"the elements.inp\"\r\n*INCLUDE, INPUT=steps.inp\r\n*NSET, NSET=last\r\n9\r\n";
  const auto path = folder.write("main.inp", main);
  folder.write("sub/nodes.dat", "\xEF\xBB\xBF** nodes\n2, 1., 0.\n*INCLUDE, INPUT=more.dat\n");
  folder.write("sub/more.dat", "3, 1., 1.\n4, 0., 1.\n");
  folder.write("the elements.inp", "1, 1, 2, 3\n2, 1, 3, 4\n");
  folder.write("steps.inp", "*STEP\n*END STEP\n");
  MeshDocument document = read_mesh(path);
  CHECK(document.points == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 3, 3, 0});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 2, 0, 2, 3});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "'more.dat'"));
  CHECK(document.point_sets == std::vector<NamedSet>{{"last", {4}}});

  SECTION("nothing has moved") {
    write_mesh(folder / "out.inp", document);
    CHECK(bytes_of(folder / "out.inp") == main);
  }
  SECTION("only nodes of the file itself have moved") {
    document.points[12] = 4;
    write_mesh(folder / "out.inp", document);
    CHECK(bytes_of(folder / "out.inp") == replace_all(main, "9, 3.", "9, 4"));
  }
  SECTION("nodes of an included file have moved") {
    document.points[6] = 0.875;
    write_mesh(folder / "out.inp", document);
    CHECK(bytes_of(folder / "out.inp") ==
          replace_all(main, "*Include, input=sub/nodes.dat", "** nodes\n2, 1., 0.\n3, 0.875, 1.\n4, 0., 1."));
    CHECK(read_mesh(folder / "out.inp").points == document.points);
  }
  SECTION("the output is in another folder") {
    std::filesystem::create_directory(folder / "other");
    write_mesh(folder / "other/out.inp", document);
    CHECK(bytes_of(folder / "other/out.inp") ==
          "*HEADING\r\n*NODE\r\n1, 0., 0.\r\n** nodes\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\r\n9, 3., 3.\r\n*ELEMENT, "
          "TYPE=CPS3\n1, 1, 2, 3\n2, 1, 3, 4\r\n*STEP\n*END STEP\r\n*NSET, NSET=last\r\n9\r\n");
    CHECK(read_mesh(folder / "other/out.inp").cells.connectivity == document.cells.connectivity);
  }
}

TEST_CASE("files that include themselves, or files that are not there, are refused") {
  const ScratchFolder folder;
  folder.write("a.inp", "*NODE\n1, 0.\n*INCLUDE, INPUT=b.inp\n");
  folder.write("b.inp", "** back\n*INCLUDE, INPUT=a.inp\n");
  CHECK(
      says(message_of<ReadError>([&] { read_mesh(folder / "a.inp"); }), "b.inp:2: the file 'a.inp' is included in it"));
  CHECK(says(inp.failure_of("*NODE\n*INCLUDE, INPUT=none.inp\n"),
             "mesh.inp:2: the file 'none.inp' that is included here"));
}

TEST_CASE("what is wrong in an input file is said with its line") {
  const auto fails = [](const std::string& text, const std::string& words) {
    CAPTURE(text);
    CHECK(says(inp.failure_of(text), words));
  };
  fails("hello\n", "mesh.inp:1: expected a keyword line of Abaqus");
  fails("", "is not an Abaqus mesh: it has no *NODE");
  fails("*HEADING\nx\n", "is not an Abaqus mesh: it has no *NODE");
  fails("*NODE\nx, 1., 2.\n", "mesh.inp:2: expected a node number, got 'x'");
  fails("*NODE\n1, 1., 2,5e\n", "mesh.inp:2: node 1: expected a coordinate (a finite number), got '5e'");
  fails("*NODE\n1, nan, 2.\n", "mesh.inp:2: node 1: expected a coordinate");
  fails("*NODE\n1, 0.\n\n1, 1.\n", "mesh.inp:4: there is a node 1 before this one");
  fails(square + "*ELEMENT, TYPE=CPS3\n7, 1, 2, 4\n", "mesh.inp:20: there is an element 7 before this one");
  fails(square + "*ELEMENT, TYPE=CPS3\n8, 1, 2, 5\n", "mesh.inp:20: this element refers to node 5, which there is not");
  fails("*USER ELEMENT, NODES=3x, TYPE=U1\n", "mesh.inp:1: expected the number of nodes of a user element (NODES=...)");
  fails("*USER ELEMENT, NODES=0, TYPE=U1\n", "mesh.inp:1: expected the number of nodes of a user element");
  fails(square + "*ELEMENT\n8, 1, 2, 4\n", "mesh.inp:19: *ELEMENT states no TYPE");
  fails(square + "*ELEMENT, TYPE=CPS3\n8, 1, 2\n9, 1, 2, 4\n",
        "mesh.inp:20: an element of type 'CPS3' has 3 nodes, "
        "this one has 2");
  fails(square + "*ELEMENT, TYPE=XYZ\n8\n", "mesh.inp:20: expected the nodes of an element, got its number alone");
  fails(square + "*ELEMENT, TYPE=CPS3\n8, 1, 2, 4, 30\n", "mesh.inp:20: an element of type 'CPS3' has 3 nodes, this");
  fails(square + "*ELEMENT, TYPE=CPS3\n8, 1, 2,\n*STEP\n", "mesh.inp:21: the element before this line ends without");
  fails(square + "*ELEMENT, TYPE=CPS3\n8, 1, 2,", "mesh.inp:20: the last element ends without its last nodes");
  fails("*NODE\n1,0\n*NGEN\n1, 5, 1\n", "mesh.inp:3: *NGEN makes or moves nodes or elements by a rule");
  fails("*SYSTEM\n1,1,1\n*NODE\n1,0\n", "mesh.inp:3: the coordinates of these nodes are in a system of their own");
  fails("*NODE, SYSTEM=C\n1,0\n", "mesh.inp:1: the coordinates of these nodes are in a system of their own (SYSTEM=C)");
  fails("*NODE\n1,0\n*NSET\n1\n", "mesh.inp:3: *NSET states no name");
  fails("*NODE\n1,0\n*NSET, NSET=a, INSTANCE=b\n1\n", "mesh.inp:3: there is no instance 'b' before this line");
}

TEST_CASE("sets of sets that explode are refused") {
  std::string text = "*NODE\n1,0\n2,1\n*NSET, NSET=s0\n1, 2\n";
  for (int i = 1; i < 60; ++i) {
    const std::string before = "s" + std::to_string(i - 1);
    text += "*NSET, NSET=s" + std::to_string(i) + "\n" + before + "," + before + "\n";
  }
  CHECK(says(inp.failure_of(text), "its sets and groups have more members"));
  CHECK(inp.read("*NODE\n1,0\n2,1\n*NSET, NSET=a, GENERATE\n1, 9000000000000000000, 1\n").point_sets[0].members ==
        std::vector<std::int32_t>{0, 1});
}

TEST_CASE("a mesh of another format keeps its groups, their names and its sets") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.1};
  const auto add = [&](std::uint8_t type, const std::vector<std::int32_t>& nodes) {
    document.cells.append(type, nodes);
  };
  add(cell_type::vertex, {2});
  add(cell_type::line, {0, 1});
  add(cell_type::triangle, {0, 1, 2});
  add(cell_type::triangle, {0, 2, 3});
  add(cell_type::polygon, {0, 1, 2, 3, 1});
  document.cell_arrays.push_back(trismooth::make_data_array<std::int32_t>("gmsh:physical", 1, {5, 1, 1, 2, 2}));
  auto description = std::make_shared<trismooth::ArrayDescription>();
  description->value_names = {{5, 0, "corner"}, {1, 1, "wall"}, {1, 2, "copper part"}, {2, 2, "Wall"}};
  document.cell_arrays[0].description = description;
  document.cell_arrays.push_back(trismooth::make_data_array<double>("t", 1, {1, 2, 3, 4, 5}));
  document.point_sets = {{"inlet", {0, 3}}};
  CHECK(inp.written(document) ==
        "*HEADING\nwritten by trismooth\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0.1\n"
        "*ELEMENT, TYPE=T3D2\n2, 1, 2\n*ELEMENT, TYPE=CPS3\n3, 1, 2, 3\n4, 1, 3, 4\n*ELSET, ELSET=wall\n2\n"
        "*ELSET, ELSET=copper_part\n3\n*ELSET, ELSET=Wall_1\n4\n*NSET, NSET=corner\n3\n*NSET, NSET=inlet\n1, 4\n");
  CHECK(what_is_lost(document, FileFormat::inp) ==
        std::vector<std::string>{
            "Abaqus holds lines, faces and solids only: 1 cell of type polygon is not written",
            "Abaqus holds no cell arrays: t is not written",
            "Abaqus holds names of up to 60 letters, digits, _ and -, a letter first: changed are copper part (as "
            "copper_part)",
            "Abaqus holds each name once, whatever the case of its letters: changed are Wall (as Wall_1)"});
  const MeshDocument back = inp.read(inp.written(document));
  CHECK(region_names(back) == std::vector<ValueName>{{1, 1, "wall"}, {2, 2, "copper_part"}, {3, 2, "Wall_1"}});
}

TEST_CASE("groups that overlap are written whole, each once and under its own name") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{2});
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{3});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 2, 3});
  // The last triangle is in `all` first, and in 7, which has no name, and `air` as well; so are the vertices.
  document.cell_arrays.push_back(trismooth::make_data_array<std::int32_t>("gmsh:physical", 1, {4, 3, 2, 1, 2}));
  auto description = std::make_shared<trismooth::ArrayDescription>();
  description->value_names = {{3, 0, "ends"}, {4, 0, "end"}, {2, 1, "all"}, {1, 2, "steel"}, {2, 2, "all"}};
  document.cell_arrays[0].description = description;
  document.cell_sets = {{"ends", {0, 1}}, {"all", {3, 4}}, {"air", {4}}};
  CHECK(says(inp.written(document),
             "*ELSET, ELSET=all\n3\n*ELSET, ELSET=steel\n4\n*ELSET, ELSET=all_1\n4, 5\n*ELSET, ELSET=air\n5\n"
             "*NSET, NSET=end\n3\n*NSET, NSET=ends\n3, 4\n"));
  // A line and faces share a name.
  CHECK(what_is_lost(document, FileFormat::inp) ==
        std::vector<std::string>{
            "Abaqus holds each name once, whatever the case of its letters: changed are all (as all_1)"});
  CHECK(region_names(inp.read(inp.written(document))) ==
        std::vector<ValueName>{{1, 1, "all"}, {2, 2, "steel"}, {4, 2, "air"}});
}

}  // namespace trismooth::inp_test
