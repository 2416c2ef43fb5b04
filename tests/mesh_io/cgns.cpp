// SPDX-License-Identifier: BSD-3-Clause
#ifdef TRISMOOTH_HAS_HDF5

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/says.h"
#include "support/small_cgns.h"
#include "support/text_format.h"

namespace trismooth::cgns_test {

using test_support::SmallCgns;

const TextFormat cgns(".cgns");

const std::vector<double> plate_points{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0};

/// A square of four triangles around a point as the zone of that name.
void add_zone(SmallCgns& file, const std::string& name, double shift = 0) {
  file.zone(name, 5, 4);
  file.coordinate(name, 'X', std::vector<double>{0 + shift, 2 + shift, 2 + shift, 0 + shift, 0.75 + shift});
  file.coordinate(name, 'Y', std::vector<double>{0, 0, 2, 2, 1.25});
  file.section(name + "/Faces", 5, 1, 4, {1, 2, 5, 2, 3, 5, 3, 4, 5, 4, 1, 5});
}

std::string plate_with(const std::function<void(SmallCgns&)>& change) {
  SmallCgns file;
  file.base(2);
  add_zone(file, "Plate");
  change(file);
  return file.bytes();
}

TEST_CASE("CGNS: zones, sections and conditions are read, and written back byte for byte") {
  const std::string bytes = plate_with([](SmallCgns& file) {
    file.section("Plate/Sides", 3, 5, 6, {1, 2, 2, 3});
    file.condition("Plate", "inlet", "EdgeCenter", {5});
    file.condition("Plate", "steel", "CellCenter", {1, 2, 3});
    file.condition("Plate", "upper", "CellCenter", {3, 4});
    file.condition("Plate", "corners", "Vertex", {1, 3});
    file.node("/B/walls", "Family_t", "MT");
    file.text("/B/walls/alias", "FamilyName_t", "outer walls");
    file.condition("Plate", "w", "EdgeCenter", {6});
    file.text("/B/Plate/BC/w/FamilyName", "FamilyName_t", "walls");
  });
  const MeshDocument document = cgns.read(bytes);
  CHECK(document.format == FileFormat::cgns);
  CHECK(document.points == plate_points);
  CHECK(document.cells.types == std::vector<std::uint8_t>{5, 5, 5, 5, cell_type::line, cell_type::line});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 1, 1, 2});
  const DataArray* const groups = find_array(document.cell_arrays, "cgns:group");
  REQUIRE(groups != nullptr);
  std::vector<std::string> names;
  for (const std::int64_t value : groups->as<std::int64_t>()) {
    for (const ValueName& name : groups->description->value_names) {
      if (name.value == value) {
        names.push_back(name.name);
      }
    }
  }
  CHECK(names == std::vector<std::string>{"steel", "steel", "upper", "upper", "inlet", "outer walls"});
  CHECK(document.cell_sets == std::vector<NamedSet>{{"steel", {0, 1, 2}}});
  CHECK(document.point_sets == std::vector<NamedSet>{{"corners", {0, 2}}});
  CHECK(document.notes.empty());
  CHECK(cgns.written(document) == bytes);
}

TEST_CASE("CGNS: of a mesh whose vertices move the file differs in their coordinates alone") {
  const std::string bytes = plate_with([](SmallCgns&) {});
  MeshDocument document = cgns.read(bytes);
  document.points[12] = 1;
  const std::string written = cgns.written(document);
  REQUIRE(written.size() == bytes.size());
  const Hdf5Reader after("after", written);
  CHECK(after.read<double>("/B/Plate/G/CoordinateX/ data") == std::vector<double>{0, 2, 2, 0, 1});
  CHECK(after.read<double>("/B/Plate/G/CoordinateY/ data") == std::vector<double>{0, 0, 2, 2, 1.25});
  MeshDocument back = cgns.read(written);
  back.points = plate_points;
  CHECK(cgns.written(back) == bytes);
}

TEST_CASE("CGNS: elements of mixed sections and polygons are read in both of their forms") {
  SmallCgns file;
  file.base(2);
  file.zone("Z", 5, 4);
  file.coordinate("Z", 'X', std::vector<double>{0, 2, 2, 0, 0.75});
  file.coordinate("Z", 'Y', std::vector<double>{0, 0, 2, 2, 1.25});
  file.section("Z/Mixed", 20, 1, 2, {5, 1, 2, 5, 7, 1, 2, 3, 4});
  file.section("Z/NewMixed", 20, 3, 3, {3, 1, 2});
  file.values("/B/Z/NewMixed/ElementStartOffset", "DataArray_t", "I4", std::vector<std::int32_t>{0, 3});
  file.section("Z/OldPolygons", 22, 4, 4, {3, 2, 3, 5});
  file.section("Z/Polygons", 22, 5, 6, {3, 4, 5, 4, 1, 2, 5});
  file.values("/B/Z/Polygons/ElementStartOffset", "DataArray_t", "I4", std::vector<std::int32_t>{0, 3, 7});
  const CellList cells = cgns.read(file.bytes()).cells;
  CHECK(cells.types == std::vector<std::uint8_t>{5, 9, 3, 7, 7, 7});
  CHECK(cells.connectivity == std::vector<std::int32_t>{0, 1, 4, 0, 1, 2, 3, 0, 1, 1, 2, 4, 2, 3, 4, 3, 0, 1, 4});
}

TEST_CASE("CGNS: several zones are joined, each a group, and points that they share are held") {
  const std::string bytes = plate_with([](SmallCgns& file) {
    add_zone(file, "Right", 2);
    file.node("/B/Plate/Links", "ZoneGridConnectivity_t", "MT");
    file.text("/B/Plate/Links/L", "GridConnectivity_t", "Right");
    file.values("/B/Plate/Links/L/PointList", "IndexArray_t", "I4", std::vector<std::int32_t>{2, 3});
    file.values("/B/Plate/Links/L/PointListDonor", "IndexArray_t", "I4", std::vector<std::int32_t>{1, 4});
  });
  MeshDocument document = cgns.read(bytes);
  CHECK(document.point_count() == 10);
  CHECK(document.points[15] == 2);
  CHECK(document.cells[4][0] == 5);
  CHECK(document.implied_sets == std::vector<NamedSet>{{"cgns:connectivity", {1, 2}}});
  CHECK(document.periodic_pairs == std::vector<std::array<std::int32_t, 2>>{{1, 5}, {2, 8}});
  const DataArray* const groups = find_array(document.cell_arrays, "cgns:group");
  REQUIRE(groups != nullptr);
  CHECK(groups->description->value_names == std::vector<ValueName>{{1, 2, "Plate"}, {2, 2, "Right"}});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "several zones, which are joined"));
  document.points[3 * 9] = 3;
  const std::string written = cgns.written(document);
  CHECK(Hdf5Reader("written", written).read<double>("/B/Right/G/CoordinateX/ data") ==
        std::vector<double>{2, 4, 4, 2, 3});
  CHECK(cgns.read(written).points == document.points);
}

TEST_CASE("CGNS: solutions at vertices are point arrays, and change in their places; others are named and kept") {
  MeshDocument document = cgns.read(plate_with([](SmallCgns& file) {
    file.node("/B/Plate/Flow", "FlowSolution_t", "MT");
    file.values("/B/Plate/Flow/Pressure", "DataArray_t", "R8", std::vector<double>{1, 2, 3, 4, 5});
    file.node("/B/Plate/Later", "FlowSolution_t", "MT");
    file.values("/B/Plate/Later/Pressure", "DataArray_t", "R4", std::vector<float>{1, 2, 3, 4, 6});
    file.node("/B/Plate/Cells", "FlowSolution_t", "MT");
    file.text("/B/Plate/Cells/GridLocation", "GridLocation_t", "CellCenter");
    file.values("/B/Plate/Cells/Density", "DataArray_t", "R8", std::vector<double>{1, 2, 3, 4});
    file.values("/B/Plate/Cells/Speed", "DataArray_t", "R8", std::vector<double>{1, 2, 3});
  }));
  REQUIRE(document.point_arrays.size() == 2);
  CHECK(values_of<double>(document.cell_arrays, "Density") == std::vector<double>{1, 2, 3, 4});
  REQUIRE(document.notes.size() == 1);
  CHECK(document.notes[0] ==
        "Solutions that have no numbers at all vertices or all cells are kept in CGNS output only: Speed.");
  for (DataArray& array : document.point_arrays) {
    if (array.type == ScalarType::float32) {
      CHECK(array.as<float>()[4] == 6);
      array = make_data_array(array.name, 1, std::vector<float>{1, 2, 3, 4, 7});
    }
  }
  const std::string written = cgns.written(document);
  CHECK(Hdf5Reader("written", written).read<float>("/B/Plate/Later/Pressure/ data").back() == 7);
}

TEST_CASE("CGNS: a mesh from elsewhere gets conditions and families for its groups, sets and names") {
  MeshDocument document;
  document.points = plate_points;
  for (std::int32_t i = 0; i < 4; ++i) {
    document.cells.append(cell_type::triangle, std::vector<std::int32_t>{i, (i + 1) % 4, 4});
  }
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::polygon, std::vector<std::int32_t>{0, 1, 2, 3, 4});
  document.cell_sets = {{"steel/core", {0, 1}}, {"inlet", {4}}, {"upper", {1, 2, 5}}};
  document.point_sets = {{"supports", {0, 1}}};
  const std::string bytes = cgns.written(document);
  const MeshDocument again = cgns.read(bytes);
  CHECK(again.points == document.points);
  CHECK(again.cells.types == document.cells.types);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(again.cell_sets == std::vector<NamedSet>{{"upper", {1, 2, 5}}});
  CHECK(again.point_sets == std::vector<NamedSet>{{"supports", {0, 1}}});
  std::vector<std::string> lost = what_is_lost(document, FileFormat::cgns);
  REQUIRE(lost.size() == 1);
  CHECK(says(lost[0], "'steel/core' (as steel_core)"));
  CHECK(cgns.written(document) == bytes);
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 4});
  lost = what_is_lost(document, FileFormat::cgns);
  REQUIRE(lost.size() == 2);
  CHECK(says(lost[1], "written in another order"));
}

/// A row of squares, some of which are two triangles.
MeshDocument row_of(const std::string& kinds) {
  MeshDocument document;
  for (std::size_t x = 0; x <= kinds.size(); ++x) {
    document.points.insert(document.points.end(), {static_cast<double>(x), 0, 0, static_cast<double>(x), 1, 0});
  }
  for (std::size_t x = 0; x < kinds.size(); ++x) {
    const auto a = static_cast<std::int32_t>(2 * x);
    if (kinds[x] == 'q') {
      document.cells.append(cell_type::quad, std::vector<std::int32_t>{a, a + 2, a + 3, a + 1});
    } else {
      document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + 2, a + 3});
      document.cells.append(cell_type::triangle, std::vector<std::int32_t>{a, a + 3, a + 1});
    }
  }
  return document;
}

TEST_CASE("CGNS: triangles and quadrilaterals of one region come back as one, in their order") {
  // In turn, and those of a type together.
  for (const std::string& kinds : {std::string("qtqqtq"), std::string("qqqtt"), std::string("tttqq")}) {
    MeshDocument document = row_of(kinds);
    const std::string bytes = cgns.written(document);
    const Hdf5Reader file("file", bytes);
    CHECK((file.kind_of("/Base/Zone/Faces") == Hdf5Kind::group) == (kinds[0] == 'q' && kinds[1] == 't'));
    const MeshDocument again = cgns.read(bytes);
    CHECK(again.cells.types == document.cells.types);
    CHECK(again.cells.connectivity == document.cells.connectivity);
    CHECK(again.cell_arrays.empty());
    CHECK(again.notes.empty());
    CHECK(what_is_lost(document, FileFormat::cgns).empty());
    // Two regions stay two.
    std::vector<std::int32_t> materials(document.cells.size(), 1);
    materials[0] = 2;
    document.cell_arrays = {make_data_array("material", 1, materials)};
    const MeshDocument regions = cgns.read(cgns.written(document));
    CHECK(regions.cells.connectivity == document.cells.connectivity);
    const std::vector<std::int64_t> groups = values_of<std::int64_t>(regions.cell_arrays, "cgns:group");
    REQUIRE(groups.size() == materials.size());
    for (std::size_t cell = 1; cell < groups.size(); ++cell) {
      CHECK(groups[cell] == groups[1]);
      CHECK(groups[cell] != groups[0]);
    }
  }
}

TEST_CASE("CGNS: sections are regions unless the type of their elements is all that tells them apart") {
  // The names of two sections of faces, of triangles and of what is said, and the groups that they make.
  struct Case {
    std::string first, second;
    std::int32_t second_type;
    std::vector<std::string> groups;
    bool are_joined;
  };
  for (const Case& sections : {Case{"Tri", "Quad", 7, {}, true},
                               {"Elements_5", "Elements_7", 7, {}, false},
                               {"Section1", "Section2", 7, {}, true},
                               {"fluid_tri", "fluid_quad", 7, {}, true},
                               {"fluid", "solid", 7, {"fluid", "solid"}, false},
                               {"Section1", "Section2", 5, {"Section1", "Section2"}, false}}) {
    SmallCgns file;
    file.base(2);
    file.zone("Z", 6, 3);
    file.coordinate("Z", 'X', std::vector<double>{0, 1, 2, 0, 1, 2});
    file.coordinate("Z", 'Y', std::vector<double>{0, 0, 0, 1, 1, 1});
    file.section("Z/" + sections.first, 5, 1, 2, {1, 2, 5, 1, 5, 4});
    if (sections.second_type == 7) {
      file.section("Z/" + sections.second, 7, 3, 3, {2, 3, 6, 5});
    } else {
      file.section("Z/" + sections.second, 5, 3, 3, {2, 3, 6});
    }
    const MeshDocument document = cgns.read(file.bytes());
    const DataArray* const groups = find_array(document.cell_arrays, "cgns:group");
    std::vector<std::string> names;
    for (std::size_t i = 0; groups != nullptr && i < groups->description->value_names.size(); ++i) {
      names.push_back(groups->description->value_names[i].name);
    }
    CHECK(names == sections.groups);
    CHECK(values_of<std::int32_t>(document.cell_arrays, "cgns:section") ==
          (sections.are_joined ? std::vector<std::int32_t>{1, 1, 2} : std::vector<std::int32_t>{}));
  }
}

TEST_CASE("CGNS: sections of a region are one group beside those of another, and lines keep their names") {
  SmallCgns file;
  file.base(2);
  file.zone("Z", 6, 4);
  file.coordinate("Z", 'X', std::vector<double>{0, 1, 2, 0, 1, 2});
  file.coordinate("Z", 'Y', std::vector<double>{0, 0, 0, 1, 1, 1});
  file.section("Z/copper TRI_3", 5, 1, 1, {1, 2, 5});
  file.section("Z/AirTriangles", 5, 2, 2, {1, 5, 4});
  file.section("Z/copper QUAD_4", 7, 3, 3, {2, 3, 6, 5});
  file.section("Z/inlet", 3, 4, 4, {1, 4});
  const MeshDocument document = cgns.read(file.bytes());
  CHECK(values_of<std::int64_t>(document.cell_arrays, "cgns:group") == std::vector<std::int64_t>{1, 2, 1, 3});
  CHECK(find_array(document.cell_arrays, "cgns:group")->description->value_names ==
        std::vector<ValueName>{{1, 2, "copper"}, {2, 2, "AirTriangles"}, {3, 1, "inlet"}});
  CHECK(values_of<std::int32_t>(document.cell_arrays, "cgns:section") == std::vector<std::int32_t>{1, 2, 3, 4});
}

TEST_CASE("CGNS: point and cell arrays are solutions, and come back as they were") {
  MeshDocument document = row_of("qtq");
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  const std::vector<double> flow{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  document.point_arrays = {make_data_array("flow", 2, flow),
                           make_data_array("heat", 1, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7.5F})};
  document.cell_arrays = {
      make_data_array("load", 3, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0}),
      make_data_array("count", 1, std::vector<std::uint8_t>{5, 4, 3, 2, 1}),
      make_data_array("a/b", 4, std::vector<float>(20, 1))};
  MeshDocument again = cgns.read(cgns.written(document));
  CHECK(values_of<double>(again.point_arrays, "flow") == flow);
  CHECK(find_array(again.point_arrays, "flow")->components == 2);
  CHECK(values_of<float>(again.point_arrays, "heat") == std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7.5F});
  std::vector<double> load = values_of<double>(again.cell_arrays, "load");
  REQUIRE(load.size() == 15);
  CHECK(std::isnan(load.back()));
  load.resize(12);
  CHECK(load == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(values_of<std::int32_t>(again.cell_arrays, "count") == std::vector<std::int32_t>{5, 4, 3, 2, 0});
  CHECK(again.notes.empty());
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::cgns);
  REQUIRE(lost.size() == 3);
  CHECK(says(lost[0], "those of cell arrays at 1 other cell are not written"));
  CHECK(says(lost[1], "a/b (a/b_1 to a/b_4)"));
  CHECK(says(lost[2], "'a/b_1' (as a_b_1)"));
  // A component changes in its place.
  std::vector<double> changed = flow;
  changed[3] = 30;
  for (DataArray& array : again.point_arrays) {
    array = array.name == "flow" ? make_data_array("flow", 2, changed) : array;
  }
  CHECK(values_of<double>(cgns.read(cgns.written(again)).point_arrays, "flow") == changed);
}

TEST_CASE("CGNS: what cannot be a mesh is refused with its place") {
  const auto refused = [](const std::function<void(SmallCgns&)>& change) {
    return cgns.failure_of(plate_with(change));
  };
  CHECK(refused([](SmallCgns& file) { file.zone("Grid", 3, 3, "Structured"); }) ==
        "mesh.cgns: the node 'Grid' is a structured zone, which is not read: write it as an unstructured one");
  CHECK(says(refused([](SmallCgns& file) { file.node("/B/Plate/G2", "GridCoordinates_t", "MT"); }), "several grids"));
  CHECK(says(refused([](SmallCgns& file) { file.zone("Other", 3, 1); }), "'G' has no CoordinateX"));
  CHECK(says(refused([](SmallCgns& file) {
               file.zone("Other", 3, 1);
               file.coordinate("Other", 'X', std::vector<double>{0, 1});
             }),
             "'CoordinateX' has 2 numbers, expected one for each of the zone's 3 vertices"));
  CHECK(says(refused([](SmallCgns& file) {
               file.zone("Other", 2, 1);
               file.coordinate("Other", 'X', std::vector<double>{0, std::numeric_limits<double>::infinity()});
             }),
             "not finite at vertex 2"));
  const auto section = [&refused](std::int32_t type, std::int32_t first, std::int32_t last,
                                  const std::vector<std::int32_t>& nodes) {
    return refused([&](SmallCgns& file) { file.section("Plate/More", type, first, last, nodes); });
  };
  CHECK(says(section(5, 5, 5, {1, 2, 6}), "'More' names vertex 6; its zone has 5, counted from 1"));
  CHECK(says(section(5, 5, 5, {1, 2, 0}), "names vertex 0"));
  CHECK(says(section(5, 4, 4, {1, 2, 3}), "that the section before it has, too"));
  CHECK(says(section(5, 5, 6, {1, 2, 3}), "which are not those of the elements 5 to 6"));
  CHECK(says(section(23, 5, 5, {1, 2, 3}), "elements of the type 23"));
  CHECK(says(section(20, 5, 5, {99, 1, 2}), "an element of the type 99"));
  CHECK(says(section(20, 5, 5, {5, 1, 2}), "which are not those"));
  CHECK(says(section(22, 5, 5, {2, 1, 2}), "a polygon of fewer than 3 nodes"));
  CHECK(says(section(22, 5, 5, {-2, 1, 2}), "which are not those"));
  CHECK(says(refused([](SmallCgns& file) { file.condition("Plate", "wall", "CellCenter", {9}); }),
             "'wall' names element 9, which is none of its zone"));
  CHECK(says(refused([](SmallCgns& file) { file.condition("Plate", "wall", "Vertex", {0}); }), "names vertex 0"));
  SmallCgns empty;
  CHECK(says(cgns.failure_of(empty.bytes()), "has no base"));
  CHECK(says(cgns.failure_of("@(#)ADF Database Version A02011>....."), "'cgnsconvert -h in.cgns out.cgns'"));
}

TEST_CASE("CGNS: links are not followed, and nodes that hold themselves end") {
  const std::string outside = plate_with([](SmallCgns& file) {
    const Hdf5Lock lock;
    H5Lcreate_external("/etc/passwd", "/x", file.file().id(), "/B/Plate/E", H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(says(cgns.failure_of(outside), "the node 'E' is a link to elsewhere"));
  CHECK(says(cgns.failure_of(plate_with([](SmallCgns& file) { file.node("/B/Plate/E", "", "LK"); })),
             "the node 'E' is a link to elsewhere"));
  const std::string circle = plate_with([](SmallCgns& file) {
    const Hdf5Lock lock;
    H5Lcreate_hard(file.file().id(), "/B", file.file().id(), "/B/Plate/B", H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(cgns.read(circle).points == plate_points);
}

}  // namespace trismooth::cgns_test

#endif
