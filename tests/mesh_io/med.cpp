// SPDX-License-Identifier: BSD-3-Clause
#ifdef TRISMOOTH_HAS_HDF5

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/hdf5/hdf5_reader.h"
#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"
#include "support/says.h"
#include "support/small_hdf5.h"
#include "support/text_format.h"

namespace trismooth::med_test {

using test_support::SmallHdf5;

const TextFormat med(".med");

const std::string mesh = "/ENS_MAA/plate";
const std::string step = mesh + "/-0000000000000000001-0000000000000000001";
const std::string families = "/FAS/plate";
const std::vector<double> plate_points{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0};

/// A list of nodes or elements, as many as `nodes` has rows; each of these becomes a column.
void add_elements(SmallHdf5& file, const std::string& type, const std::vector<std::vector<std::int32_t>>& elements) {
  std::vector<std::int32_t> by_node;
  for (std::size_t k = 0; k < elements.front().size(); ++k) {
    for (const auto& element : elements) {
      by_node.push_back(element[k]);
    }
  }
  file.group(step + "/MAI/" + type);
  file.values(step + "/MAI/" + type + "/NOD", by_node);
}

void add_family(SmallHdf5& file, const std::string& kind, std::int32_t number, std::vector<std::string> groups) {
  const std::string family = families + "/" + kind + "/F" + std::to_string(number);
  file.group(family);
  file.attribute(family, "NUM", number);
  std::string names;
  for (std::string& name : groups) {
    name.resize(80, names.empty() ? ' ' : '\0');  // both are in use
    names += name;
  }
  file.group(family + "/GRO");
  file.rows(family + "/GRO/NOM", 80, names);
}

/// A square of four triangles, a line and a point; what `spoil` leaves out or adds makes it another file.
struct Plate {
  std::int32_t axes = 2;
  std::vector<double> coordinates{0, 2, 2, 0, 0.75, 0, 0, 2, 2, 1.25};
  std::vector<std::vector<std::int32_t>> triangles{{1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 1, 5}};
};

void add_plate(SmallHdf5& file, const Plate& plate = {}) {
  file.group("/ENS_MAA");
  file.group(mesh);
  file.attribute(mesh, "ESP", plate.axes);
  file.group(step);
  file.group(step + "/NOE");
  file.values(step + "/NOE/COO", plate.coordinates);
  file.group(step + "/MAI");
  add_elements(file, "TR3", plate.triangles);
}

void add_families(SmallHdf5& file) {
  file.group("/FAS");
  file.group(families);
  file.group(families + "/NOEUD");
  file.group(families + "/ELEME");
}

std::string plate_with(const std::function<void(SmallHdf5&)>& change, const Plate& plate = {}) {
  SmallHdf5 file;
  add_plate(file, plate);
  change(file);
  return file.bytes();
}

std::string grouped_plate() {
  return plate_with([](SmallHdf5& file) {
    add_elements(file, "SE2", {{1, 2}});
    add_families(file);
    add_family(file, "ELEME", -1, {"steel core"});
    add_family(file, "ELEME", -2, {"upper half", "steel core"});
    add_family(file, "ELEME", -3, {"inlet"});
    add_family(file, "NOEUD", 7, {"supports"});
    file.values(step + "/MAI/TR3/FAM", std::vector<std::int32_t>{-1, -2, 0, -1});
    file.values(step + "/MAI/SE2/FAM", std::vector<std::int32_t>{-3});
    file.values(step + "/NOE/FAM", std::vector<std::int32_t>{7, 7, 0, 0, 0});
    file.values(step + "/NOE/NUM", std::vector<std::int32_t>{11, 12, 13, 14, 20});
  });
}

TEST_CASE("MED: nodes, elements and groups are read, and written back byte for byte") {
  const std::string bytes = grouped_plate();
  const MeshDocument document = med.read(bytes);
  CHECK(document.format == FileFormat::med);
  CHECK(document.points == plate_points);
  CHECK(document.point_type == ScalarType::float64);
  // By their types, in MED's order.
  CHECK(document.cells.types == std::vector<std::uint8_t>{cell_type::line, 5, 5, 5, 5});
  CHECK(document.cells.connectivity == std::vector<std::int32_t>{0, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
  CHECK(document.point_labels == std::vector<std::int64_t>{11, 12, 13, 14, 20});
  CHECK(values_of<std::int64_t>(document.cell_arrays, "med:group") == std::vector<std::int64_t>{3, 1, 2, 0, 1});
  CHECK(find_array(document.cell_arrays, "med:group")->description->value_names ==
        std::vector<ValueName>{{1, 2, "steel core"}, {2, 2, "upper half"}, {3, 1, "inlet"}});
  // A group of which a smaller one has a cell.
  CHECK(document.cell_sets == std::vector<NamedSet>{{"steel core", {1, 2, 4}}});
  CHECK(document.point_sets == std::vector<NamedSet>{{"supports", {0, 1}}});
  CHECK(document.notes.empty());
  CHECK(med.written(document) == bytes);
}

TEST_CASE("MED: of a mesh whose nodes move the file differs in their coordinates alone") {
  const std::string bytes = grouped_plate();
  MeshDocument document = med.read(bytes);
  document.points[12] = 1;
  document.points[13] = 1.125;
  std::string written = med.written(document);
  REQUIRE(written.size() == bytes.size());
  CHECK(med.read(written).points == document.points);
  const Hdf5Reader before("before", bytes);
  const Hdf5Reader after("after", written);
  std::vector<double> coordinates = before.read<double>(step + "/NOE/COO");
  coordinates[4] = 1;
  coordinates[9] = 1.125;
  CHECK(after.read<double>(step + "/NOE/COO") == coordinates);
  // Back in their places the file is the one that was read.
  MeshDocument back = med.read(written);
  back.points = plate_points;
  CHECK(med.written(back) == bytes);
}

TEST_CASE("MED: curved elements have their corners first, solids are turned as VTK has them") {
  SmallHdf5 file;
  add_plate(file);
  add_elements(file, "TR6", {{1, 2, 3, 4, 5, 1}});
  add_elements(file, "QU8", {{1, 2, 3, 4, 5, 1, 2, 3}});
  add_elements(file, "TE4", {{1, 2, 3, 4}});
  add_elements(file, "HE8", {{1, 2, 3, 4, 5, 1, 2, 3}});
  const CellList cells = med.read(file.bytes()).cells;
  const auto vertices = [&cells](std::uint8_t type) {
    const auto cell = static_cast<std::size_t>(std::ranges::find(cells.types, type) - cells.types.begin());
    return std::vector<std::int32_t>(cells[cell].begin(), cells[cell].end());
  };
  CHECK(vertices(cell_type::quadratic_triangle) == std::vector<std::int32_t>{0, 1, 2, 3, 4, 0});
  CHECK(vertices(cell_type::quadratic_quad) == std::vector<std::int32_t>{0, 1, 2, 3, 4, 0, 1, 2});
  CHECK(vertices(cell_type::tetrahedron) == std::vector<std::int32_t>{0, 2, 1, 3});
  CHECK(vertices(cell_type::hexahedron) == std::vector<std::int32_t>{0, 3, 2, 1, 4, 2, 1, 0});
}

TEST_CASE("MED: fields at all nodes are point arrays, and change in their places; others are named and kept") {
  const std::string bytes = plate_with([](SmallHdf5& file) {
    file.group("/CHA");
    const auto add = [&file](const std::string& name, const std::string& of_mesh) {
      file.group("/CHA/" + name);
      file.text("/CHA/" + name, "MAI", of_mesh, 64);
    };
    const auto add_values = [&file](const std::string& at, const std::vector<double>& values) {
      file.group(at);
      file.group(at + "/MED_NO_PROFILE_INTERNAL");
      file.values(at + "/MED_NO_PROFILE_INTERNAL/CO", values);
    };
    add("flow", "plate");
    file.group("/CHA/flow/1");
    add_values("/CHA/flow/1/NOE", {1, 2, 3, 4, 5, 10, 20, 30, 40, 50});
    add("heat", "plate");
    for (const std::string number : {"1", "2"}) {
      file.group("/CHA/heat/" + number);
      file.attribute("/CHA/heat/" + number, "PDT", 0.5 * std::stod(number));
      add_values("/CHA/heat/" + number + "/NOE", {1, 1, 1, 1, std::stod(number)});
    }
    add("stress", "plate");
    file.group("/CHA/stress/1");
    add_values("/CHA/stress/1/MAI.TR3", {1, 2, 3, 4});
    add("gauss", "plate");
    file.group("/CHA/gauss/1");
    add_values("/CHA/gauss/1/MAI.TR3", {1, 2, 3, 4, 5, 6, 7, 8});
    file.attribute("/CHA/gauss/1/MAI.TR3/MED_NO_PROFILE_INTERNAL", "NGA", 2);
    add("part", "plate");
    file.group("/CHA/part/1");
    add_values("/CHA/part/1/MAI.TR3", {1, 2, 3});
    add("elsewhere", "another");
    file.group("/CHA/elsewhere/1");
    add_values("/CHA/elsewhere/1/NOE", {1});
  });
  MeshDocument document = med.read(bytes);
  CHECK(document.point_arrays.size() == 3);
  CHECK(values_of<double>(document.point_arrays, "flow") == std::vector<double>{1, 10, 2, 20, 3, 30, 4, 40, 5, 50});
  CHECK(values_of<double>(document.point_arrays, "heat[0] - 0.5") == std::vector<double>{1, 1, 1, 1, 1});
  CHECK(values_of<double>(document.point_arrays, "heat[1] - 1") == std::vector<double>{1, 1, 1, 1, 2});
  CHECK(values_of<double>(document.cell_arrays, "stress") == std::vector<double>{1, 2, 3, 4});
  REQUIRE(document.notes.size() == 1);
  CHECK(document.notes[0] ==
        "Fields that have no numbers at all nodes, or at all elements of a type, are kept in MED output only: gauss, "
        "part.");
  CHECK(writes_values_of(document, FileFormat::med, "flow"));
  CHECK_FALSE(writes_values_of(document, FileFormat::med, "stress"));
  for (DataArray& array : document.point_arrays) {
    if (array.name == "flow") {
      array = make_data_array("flow", 2, std::vector<double>{1, 10, 2, 20, 3, 30, 4, 40, 5, 60});
    }
  }
  const MeshDocument again = med.read(med.written(document));
  CHECK(values_of<double>(again.point_arrays, "flow").back() == 60);
  CHECK(again.points == document.points);
}

TEST_CASE("MED: a mesh from elsewhere gets families for its groups, sets and names") {
  MeshDocument document;
  document.points = plate_points;
  for (std::int32_t i = 0; i < 4; ++i) {
    document.cells.append(cell_type::triangle, std::vector<std::int32_t>{i, (i + 1) % 4, 4});
  }
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  DataArray regions = make_data_array("material", 1, std::vector<std::int32_t>{3, 3, 5, 5, 3});
  ArrayDescription names;
  names.value_names = {{3, 2, "steel"}, {3, 1, "inlet"}};
  regions.description = std::make_shared<const ArrayDescription>(names);
  document.cell_arrays.push_back(regions);
  document.cell_sets = {{"upper", {1, 2}}, {" blanks ", {0}}, {std::string(100, 'n'), {0}}};
  document.point_sets = {{"supports", {0, 1}}, {"upper", {3}}};
  const std::string bytes = med.written(document);
  const MeshDocument again = med.read(bytes);
  CHECK(again.points == plate_points);
  CHECK(again.cells.types == std::vector<std::uint8_t>{cell_type::line, 5, 5, 5, 5});
  CHECK(values_of<std::int64_t>(again.cell_arrays, "med:element_number") == std::vector<std::int64_t>{5, 1, 2, 3, 4});
  CHECK(again.point_sets == std::vector<NamedSet>{{"supports", {0, 1}}, {"upper", {3}}});
  std::vector<std::string> groups;
  for (const ValueName& name : find_array(again.cell_arrays, "med:group")->description->value_names) {
    groups.push_back(name.name);
  }
  CHECK(std::ranges::count(groups, "inlet") == 1);
  CHECK(std::ranges::count(groups, "blanks") == 1);
  CHECK(std::ranges::count(groups, "physical 5") == 1);
  CHECK(std::ranges::count(again.cell_sets, NamedSet{"upper", {2, 3}}) == 1);
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::med);
  REQUIRE(lost.size() == 2);
  CHECK(says(lost[0], "names of groups of 80 characters at most"));
  CHECK(says(lost[0], "' blanks ' (as blanks)"));
  CHECK(says(lost[1], "by their type: they are written in another order, under their old numbers (NUM)"));
  // The same bytes each time.
  CHECK(med.written(document) == bytes);
}

TEST_CASE("MED: point and cell arrays are fields, and come back as they were") {
  MeshDocument document;
  document.points = plate_points;
  document.cells.append(cell_type::quad, std::vector<std::int32_t>{0, 1, 2, 3});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 4});
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.point_arrays = {make_data_array("heat", 1, std::vector<float>{0, 1, 2, 3, 4.5F}),
                           make_data_array("flow/in", 2, std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9})};
  constexpr std::uint64_t large = 9007199254740993;  // 2^53 + 1
  document.cell_arrays = {make_data_array("heat", 1, std::vector<double>{7, 8, 9}),
                          make_data_array("count", 1, std::vector<std::uint8_t>{3, 2, 1}),
                          make_data_array("id", 1, std::vector<std::uint64_t>{large, 2, 3}),
                          make_data_array("key", 1, std::vector<std::uint64_t>{~std::uint64_t{0}, 2, 3})};
  set_unit(document.point_arrays[1], "m/s");
  const MeshDocument again = med.read(med.written(document));
  CHECK(again.cells.types == std::vector<std::uint8_t>{cell_type::line, 5, 9});
  CHECK(values_of<double>(again.point_arrays, "heat") == std::vector<double>{0, 1, 2, 3, 4.5});
  CHECK(values_of<double>(again.point_arrays, "flow_in") == std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(values_of<double>(again.cell_arrays, "heat") == std::vector<double>{9, 8, 7});
  CHECK(values_of<std::int32_t>(again.cell_arrays, "count") == std::vector<std::int32_t>{1, 2, 3});
  CHECK(values_of<std::int64_t>(again.cell_arrays, "id") == std::vector<std::int64_t>{3, 2, std::int64_t{large}});
  CHECK(unit_of(*find_array(again.point_arrays, "flow_in")) == "m/s");
  CHECK(unit_of(*find_array(again.point_arrays, "heat")).empty());
  CHECK(again.notes.empty());
  CHECK(writes_values_of(again, FileFormat::med, "heat"));
  const std::vector<std::string> lost = what_is_lost(document, FileFormat::med);
  REQUIRE(lost.size() == 3);
  CHECK(lost[1] == "MED holds whole numbers below 2^63: key is rounded");
  CHECK(says(what_is_lost(document, FileFormat::cgns).at(0), "CGNS holds whole numbers below 2^63: key is rounded"));
  CHECK(says(lost[0],
             "names of fields of 64 characters at most, each once and without slashes: changed are 'flow/in' "
             "(as flow_in)"));
  // What is read of some elements alone.
  document.cell_arrays.clear();
  CHECK(med.read(med.written(document)).cell_arrays.size() == 1);
}

TEST_CASE("MED: a mesh in space keeps z, a flat one has two axes") {
  MeshDocument document = med.read(plate_with([](SmallHdf5&) {}));
  document.original = nullptr;
  const auto axes = [](const MeshDocument& written) {
    const std::string bytes = med.written(written);
    return Hdf5Reader("written", bytes).read_attribute<std::int64_t>("/ENS_MAA/mesh", "ESP");
  };
  CHECK(axes(document) == std::vector<std::int64_t>{2});
  document.points[2] = 0.5;
  CHECK(axes(document) == std::vector<std::int64_t>{3});
}

TEST_CASE("MED: of several meshes the first is read, and a note names the others") {
  const MeshDocument document = med.read(plate_with([](SmallHdf5& file) { file.group("/ENS_MAA/zone"); }));
  REQUIRE(document.notes.size() == 1);
  CHECK(document.notes[0] ==
        "The file has several meshes: plate is read, the others are kept in MED output only (zone).");
}

TEST_CASE("MED: families without groups tell elements apart, and those that are not described are named") {
  const MeshDocument document = med.read(plate_with([](SmallHdf5& file) {
    file.values(step + "/MAI/TR3/FAM", std::vector<std::int32_t>{-4, -4, -9, 0});
  }));
  CHECK(values_of<std::int64_t>(document.cell_arrays, "med:family") == std::vector<std::int64_t>{-4, -4, -9, 0});
  REQUIRE(document.notes.size() == 1);
  CHECK(says(document.notes[0], "families that the file does not describe"));
}

TEST_CASE("MED: what cannot be a mesh is refused with its place") {
  const auto refused = [](const std::function<void(SmallHdf5&)>& change, const Plate& plate = {}) {
    return med.failure_of(plate_with(change, plate));
  };
  const auto nothing = [](SmallHdf5&) {};
  CHECK(refused(nothing, {.axes = 1}) == "mesh.med: the mesh 'plate' is in a space of 1 dimensions, expected 2 or 3");
  CHECK(says(refused(nothing, {.coordinates = {0, 1, 2}}), "3 numbers are no 2 for each node"));
  CHECK(says(refused(nothing, {.coordinates = {0, 1, 2, 3, 4, 0, 1, 2, std::numeric_limits<double>::quiet_NaN(), 4}}),
             "node 4 has a coordinate that is not a finite number"));
  CHECK(says(refused(nothing, {.triangles = {{1, 2, 6}}}),
             "'MAI/TR3/NOD' element 1 names node 6; the file has 5 nodes, counted from 1"));
  CHECK(says(refused(nothing, {.triangles = {{1, 2, 0}}}), "names node 0"));
  CHECK(says(refused([](SmallHdf5& file) { file.values(step + "/MAI/TR3/FAM", std::vector<std::int32_t>{1}); }),
             "'MAI/TR3/FAM' has 1 families, expected one for each of 4"));
  CHECK(says(refused([](SmallHdf5& file) { file.attribute(mesh, "TYP", 1); }), "is a structured grid"));
  CHECK(says(refused([](SmallHdf5& file) { file.attribute(mesh, "REP", 1); }), "cylindrical or spherical"));
  CHECK(says(refused([](SmallHdf5& file) { file.attribute(step + "/NOE/COO", "NBR", 4); }), "numbers are no 2"));
  CHECK(says(refused([](SmallHdf5& file) { add_elements(file, "XY7", {{1}}); }), "elements of the type 'XY7'"));
  CHECK(says(refused([](SmallHdf5& file) { file.group(step + "/MAI/QU4"); }), "'MAI/QU4' has no nodes"));
  CHECK(says(refused([](SmallHdf5& file) { add_elements(file, "POG", {{1}, {2}, {3}}); }), "where its polygons begin"));
  CHECK(says(refused([](SmallHdf5& file) {
               add_elements(file, "POG", {{1}, {2}, {3}});
               file.values(step + "/MAI/POG/INN", std::vector<std::int32_t>{1, 3, 4});
             }),
             "polygon 1 has fewer than 3 nodes"));
  CHECK(says(refused([](SmallHdf5& file) {
               file.group(mesh + "/2");
               file.group(mesh + "/2/NOE");
               file.values(mesh + "/2/NOE/COO", std::vector<double>(10));
             }),
             "has other coordinates at each of 2 steps"));
  CHECK(says(refused([](SmallHdf5& file) {
               add_families(file);
               file.group(families + "/ELEME/F");
             }),
             "has no number (NUM)"));
  SmallHdf5 empty;
  CHECK(says(med.failure_of(empty.bytes()), "has no mesh"));
}

TEST_CASE("MED: links to other files are not followed, and groups that hold themselves end") {
  const std::string outside = plate_with([](SmallHdf5& file) {
    const Hdf5Lock lock;
    H5Ldelete(file.id(), (step + "/NOE/COO").c_str(), H5P_DEFAULT);
    H5Lcreate_external("/etc/passwd", "/x", file.id(), (step + "/NOE/COO").c_str(), H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(says(med.failure_of(outside), "a link, which is not followed"));
  const std::string circle = plate_with([](SmallHdf5& file) {
    const Hdf5Lock lock;
    H5Lcreate_hard(file.id(), "/", file.id(), (step + "/FAS").c_str(), H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(file.id(), "/ENS_MAA", file.id(), "/CHA", H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(med.read(circle).points == plate_points);
}

TEST_CASE("MED: a list that many families share costs no more than the file may") {
  // Each of the families is in all groups, and each element in one.
  const std::string bytes = plate_with([](SmallHdf5& file) {
    add_families(file);
    std::vector<std::string> groups;
    for (int i = 0; i < 1000; ++i) {
      groups.push_back("g" + std::to_string(i));
    }
    add_family(file, "ELEME", -1, groups);
    add_elements(file, "PO1", std::vector<std::vector<std::int32_t>>(20000, {1}));
    file.values(step + "/MAI/PO1/FAM", std::vector<std::int32_t>(20000, -1), SmallHdf5::Layout::deflated);
  });
  CHECK(says(med.failure_of(bytes), "more members than a mesh of its size can have"));
}

}  // namespace trismooth::med_test

#endif
