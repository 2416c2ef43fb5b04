// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/regions.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/mesh_io/document/region_names.h"
#include "trismooth/pipeline/input/planar_mesh.h"

#include "catch.h"
#include "mesh_io/byte_files.h"
#include "support/scratch_folder.h"
#include "support/test_meshes.h"
#include "support/triangle_document.h"

using byte_files::contains;
using trismooth::find_regions;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::planar_mesh;
using trismooth::RegionReason;
using trismooth::Regions;
using trismooth::Triangle;

namespace cell_type = trismooth::cell_type;

namespace {

using Numbers = std::vector<std::int32_t>;

/// 12 x 12 squares, each cut in two: 288 triangles.
MeshDocument grid() {
  return triangle_document(test_meshes::jittered_grid(13, 13, 0.2, 7));
}

/// A value for each triangle of grid() by its square's column and row.
template <class Value>
Numbers by_square(const Value& value) {
  Numbers values;
  for (std::int32_t cell = 0; cell < 144; ++cell) {
    values.insert(values.end(), 2, value(cell % 12, cell / 12));
  }
  return values;
}

const auto halves = [](std::int32_t column, std::int32_t) { return column < 6 ? 3 : 8; };
const auto bands = [](std::int32_t, std::int32_t row) { return row / 4; };

/// Both squares beside each other cut into triangles, with a line among them.
MeshDocument two_squares() {
  MeshDocument document;
  document.points = {0, 0, 5, 1, 0, 5, 2, 0, 5, 0, 1, 5, 1, 1, 5, 2, 1, 5};
  for (const Numbers& cell : {Numbers{0, 1, 4}, {0, 4, 3}, {1, 4}, {1, 2, 5}, {1, 5, 4}}) {
    document.cells.append(cell.size() == 2 ? cell_type::line : cell_type::triangle, cell);
  }
  return document;
}

void add(MeshDocument& document, const std::string& name, Numbers values) {
  document.cell_arrays.push_back(make_data_array(name, 1, std::move(values)));
}

Regions regions_of(const MeshDocument& document, const std::vector<std::string>& names = {}) {
  return find_regions(document, planar_mesh(document, "mesh.vtu"), names);
}

std::vector<std::string> names_of(const Regions& regions) {
  std::vector<std::string> names;
  for (const auto& array : regions.arrays) {
    names.push_back(array.name);
  }
  return names;
}

using Names = std::vector<std::string>;

/// The vertices of edges whose two triangles have different values, looked up edge by edge.
std::set<std::int32_t> interface_of(const MeshDocument& document, const Numbers& values) {
  std::map<std::pair<std::int32_t, std::int32_t>, Numbers> sides;
  for (std::size_t cell = 0; cell < document.cells.size(); ++cell) {
    const auto vertices = document.cells[cell];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      sides[std::minmax(vertices[i], vertices[(i + 1) % vertices.size()])].push_back(values[cell]);
    }
  }
  std::set<std::int32_t> ends;
  for (const auto& [edge, found] : sides) {
    if (found.size() == 2 && found[0] != found[1]) {
      ends.insert({edge.first, edge.second});
    }
  }
  return ends;
}

}  // namespace

TEST_CASE("regions are numbered from 0 by ascending value, for the triangles alone, and keep the file's names") {
  MeshDocument document = two_squares();
  // The line's value is no region.
  add(document, "region", {70, -4, 1, 70, 70});
  for (const Names& names : {Names{}, Names{"region"}}) {
    const Regions regions = regions_of(document, names);
    CHECK(names_of(regions) == Names{"region"});
    CHECK(regions.of_triangle == Numbers{1, 0, 1, 1});
    CHECK(regions.names == Names{"-4", "70"});
    CHECK(regions.arrays[0].values == 2);
    CHECK(regions.notes.empty());
  }
}

TEST_CASE("what programs call regions is known, in whatever case and however the words are joined") {
  // Taken from what these programs write, not from the list.
  for (const char* const name :
       {"region", "mat_id", "material", "MaterialIds", "CellEntityIds", "gmsh:physical", "medit:ref",
        "gmsh:geometrical", "attribute", "Attribute", "cell_tags", "Cell tags", "mesh_tags", "f", "subdomains",
        "Material", "Material ID", "MaterialIDs", "MatID", "GeometryIds", "subdomain_id", "SubdomainID", "object_id",
        "ObjectId", "ElementBlockIds", "Block Id", "block_id", "PhysicalIds", "physical", "domain", "Domain index",
        "Geometric entity index", "FamilyIdCell", "label", "Label", "ref", "marker", "cell_markers", "RegionId",
        "vtkCompositeIndex", "zone", "property_id", "PartID", "su2:tag", "nastran:ref", "avsucd:material",
        // What the readers here call them.
        "gmsh:physical", "gmsh:geometrical", "medit:ref", "freefem:label", "su2:zone", "su2:marker", "abaqus:elset",
        "nastran:pid", "2dm:material", "mfem:attribute", "triangle:attribute", "unv:group", "unv:pid", "med:group",
        "med:family", "cgns:group"}) {
    std::string upper = name;
    std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    for (const std::string& written : {std::string(name), upper}) {
      CAPTURE(written);
      MeshDocument document = grid();
      add(document, written, by_square(halves));
      const Regions regions = regions_of(document);
      REQUIRE(names_of(regions) == Names{written});
      CHECK(regions.arrays[0].reason == RegionReason::known_name);
      CHECK(regions.arrays[0].held_vertices == 13);
      CHECK(regions.notes.empty());
    }
  }
}

TEST_CASE("ids, ranks, partitions and results are no known names of regions") {
  for (const char* const name : {"",
                                 "id",
                                 "ids",
                                 "cell_id",
                                 "CellId",
                                 "GlobalElementId",
                                 "GlobalCellIds",
                                 "eid",
                                 "index",
                                 "rank",
                                 "partition",
                                 "gmsh:partition",
                                 "processor_id",
                                 "vtkProcessId",
                                 "vtkGhostType",
                                 "vtkOriginalCellIds",
                                 "pressure",
                                 "quality",
                                 "shape",
                                 "depth",
                                 "level",
                                 "flag",
                                 "value",
                                 "data",
                                 "scalars",
                                 "cell_scalars",
                                 "group",
                                 "u",
                                 "Normals",
                                 "temperature"}) {
    CAPTURE(name);
    CHECK_FALSE(trismooth::is_region_name(name));
  }
}

TEST_CASE("every array of two values or more counts: a constant one hides none, and each finds its interfaces") {
  MeshDocument document = grid();
  add(document, "region", Numbers(288, 1));
  add(document, "gmsh:physical", by_square(halves));
  add(document, "gmsh:geometrical", by_square(bands));
  const Regions regions = regions_of(document);
  CHECK(names_of(regions) == Names{"gmsh:physical", "gmsh:geometrical"});
  CHECK(regions.arrays[0].held_vertices == 13);
  CHECK(regions.arrays[1].held_vertices == 26);
  CHECK(regions.names == Names{"3, 0", "3, 1", "3, 2", "8, 0", "8, 1", "8, 2"});
  const Numbers first = by_square(halves);
  const Numbers second = by_square(bands);
  for (std::size_t a = 0; a < first.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      REQUIRE((regions.of_triangle[a] == regions.of_triangle[b]) == (first[a] == first[b] && second[a] == second[b]));
    }
  }
}

TEST_CASE("a known array that is the same everywhere is named where there is no other") {
  MeshDocument document = grid();
  add(document, "material", Numbers(288, 5));
  add(document, "region", Numbers(288, 1));
  const Regions regions = regions_of(document);
  CHECK(names_of(regions) == Names{"material"});
  CHECK(regions.count() == 1);
  CHECK(regions.arrays[0].held_vertices == 0);
}

TEST_CASE("whole numbers under another name that look like regions count, and a note says how to be rid of them") {
  MeshDocument document = grid();
  const bool as_floats = GENERATE(false, true);
  const Numbers values = by_square(bands);
  if (as_floats) {
    document.cell_arrays.push_back(make_data_array("mine", 1, std::vector<float>(values.begin(), values.end())));
  } else {
    add(document, "mine", values);
  }
  const Regions regions = regions_of(document);
  REQUIRE(names_of(regions) == Names{"mine"});
  CHECK(regions.arrays[0].reason == RegionReason::looks_like_regions);
  CHECK(regions.arrays[0].held_vertices == 26);
  REQUIRE(regions.notes.size() == 1);
  for (const char* const part : {"'mine'", "3 values", "26 vertices", "--region-array mine", "--region-array none"}) {
    CHECK(contains(regions.notes[0], part));
  }
}

TEST_CASE("numbers of cells and noise hold nothing; under a known name a note says that they are passed over") {
  MeshDocument document = grid();
  test_meshes::Random random(3);
  Numbers noise(288);
  std::ranges::generate(noise, [&] { return random.below(6); });
  Numbers ids(288);
  std::iota(ids.begin(), ids.end(), 1);
  for (const Numbers& values : {noise, ids}) {
    for (const char* const name : {"whatever", "region"}) {
      MeshDocument one = document;
      add(one, name, values);
      const Regions regions = regions_of(one);
      CHECK(regions.arrays.empty());
      CHECK(regions.of_triangle.empty());
      const bool known = std::string_view(name) == "region";
      REQUIRE(regions.notes.size() == (known ? 1 : 0));
      CHECK((!known || contains(regions.notes[0], "--region-array region")));
    }
  }
}

TEST_CASE("what looks like regions and does not count is told: parts of a parallel run, fractions, too many edges") {
  for (const char* const name : {"partition", "Partition", "gmsh:partition", "rank", "mpi_rank", "vtkProcessId",
                                 "processor_id", "proc", "pid", "vtkGhostType", "vtkOriginalCellIds", "metis_part"}) {
    CAPTURE(name);
    MeshDocument document = grid();
    add(document, name, by_square(halves));
    const Regions regions = regions_of(document);
    CHECK(regions.arrays.empty());
    REQUIRE(regions.notes.size() == 1);
    CHECK(contains(regions.notes[0], "--region-array " + std::string(name)));
  }
  MeshDocument fractions = grid();
  const Numbers values = by_square(halves);
  std::vector<double> densities(values.size());
  std::ranges::transform(values, densities.begin(), [](std::int32_t value) { return 0.5 + value; });
  fractions.cell_arrays.push_back(make_data_array("density", 1, densities));
  CHECK(regions_of(fractions).arrays.empty());
  REQUIRE(regions_of(fractions).notes.size() == 1);
  CHECK(contains(regions_of(fractions).notes[0], "whole numbers"));

  // Two triangles of each square are alike, the next square differs in one direction: 1/3 of the edges and some more.
  MeshDocument dense = grid();
  add(dense, "stripes", by_square([](std::int32_t column, std::int32_t row) { return column % 2 + 2 * (row / 3); }));
  CHECK(regions_of(dense).arrays.empty());
  REQUIRE(regions_of(dense).notes.size() == 1);
  CHECK(contains(regions_of(dense).notes[0], "% of the edges"));
  dense.cell_arrays[0].name = "region";
  CHECK(names_of(regions_of(dense)) == Names{"region"});
}

TEST_CASE("thin regions are regions: layers one element across") {
  MeshDocument document = grid();
  add(document, "layers", by_square([](std::int32_t column, std::int32_t) { return column % 2; }));
  CHECK(names_of(regions_of(document)) == Names{"layers"});
  CHECK(regions_of(document).arrays[0].held_vertices == 13 * 11);
}

TEST_CASE("arrays that the program itself added are not looked at") {
  MeshDocument document = grid();
  add(document, "trismooth:region", by_square(halves));
  add(document, "trismooth:shape", by_square(halves));
  CHECK(regions_of(document).arrays.empty());
  CHECK(regions_of(document).notes.empty());
  CHECK(names_of(regions_of(document, {"trismooth:shape"})) == Names{"trismooth:shape"});
}

TEST_CASE("an array of several components gives no regions; under a known name a note says so") {
  MeshDocument document = grid();
  document.cell_arrays.push_back(make_data_array("mat_id", 2, Numbers(2 * 288, 1)));
  document.cell_arrays.push_back(make_data_array("color", 3, Numbers(3 * 288, 1)));
  CHECK(regions_of(document).arrays.empty());
  REQUIRE(regions_of(document).notes.size() == 1);
  CHECK(contains(regions_of(document).notes[0], "'mat_id' has 2 components"));
}

TEST_CASE("arrays that are named count whatever they hold, several of them together, and no other does") {
  MeshDocument document = two_squares();
  add(document, "region", {1, 1, 1, 2, 2});
  document.cell_arrays.push_back(make_data_array("mine", 1, std::vector<double>{0.5, 0.25, 9, 0.75, 1}));
  add(document, "Yours", {1, 1, 1, 1, 2});
  const Regions one = regions_of(document, {"mine"});
  CHECK(names_of(one) == Names{"mine"});
  CHECK(one.arrays[0].reason == RegionReason::named);
  CHECK(one.of_triangle == Numbers{1, 0, 2, 3});
  CHECK(one.names == Names{"0.25", "0.5", "0.75", "1"});
  const Regions two = regions_of(document, {"yours", "region"});
  CHECK(names_of(two) == Names{"Yours", "region"});
  CHECK(two.of_triangle == Numbers{0, 0, 1, 2});
}

TEST_CASE("all arrays of a name that is given count") {
  MeshDocument document = grid();
  add(document, "part", by_square(halves));
  add(document, "part", by_square(bands));
  const Regions regions = regions_of(document, {"part"});
  CHECK(names_of(regions) == Names{"part", "part"});
  CHECK(regions.arrays[0].held_vertices == 13);
  CHECK(regions.arrays[1].held_vertices == 26);
}

TEST_CASE("none switches regions off, and goes with no other array") {
  MeshDocument document = grid();
  add(document, "region", by_square(halves));
  const Regions regions = regions_of(document, {"none"});
  CHECK(regions.arrays.empty());
  CHECK(regions.of_triangle.empty());
  CHECK(regions.notes.empty());
  CHECK(contains(message_of<std::invalid_argument>([&] { regions_of(document, {"region", "none"}); }), "none"));
}

TEST_CASE("a named array that is missing or of several components is refused, with what there is") {
  MeshDocument document = two_squares();
  const auto refusal = [&](const std::string& name) {
    return message_of<std::invalid_argument>([&] { regions_of(document, {name}); });
  };
  CHECK(contains(refusal("mine"), "'mine'"));
  CHECK(contains(refusal("mine"), "it has: none"));
  add(document, "region", Numbers(5, 1));
  document.cell_arrays.push_back(make_data_array("flux", 3, std::vector<float>(15, 1)));
  const std::vector<std::string_view> words(5, "steel");
  document.cell_labels.push_back(trismooth::make_label_array("names", words));
  CHECK(contains(refusal("mine"), "it has: region, flux, names"));
  CHECK(contains(refusal("flux"), "3 components"));
}

TEST_CASE("arrays of texts give regions, which have these names") {
  MeshDocument document = grid();
  std::vector<std::string_view> texts;
  for (const std::int32_t value : by_square(halves)) {
    texts.emplace_back(value == 3 ? "steel" : "air");
  }
  for (const auto& [name, reason] :
       {std::pair{"material", RegionReason::known_name}, {"what it is made of", RegionReason::looks_like_regions}}) {
    document.cell_labels = {trismooth::make_label_array(name, texts)};
    for (const Names& names : {Names{}, Names{name}}) {
      const Regions regions = regions_of(document, names);
      REQUIRE(names_of(regions) == Names{name});
      CHECK(regions.arrays[0].reason == (names.empty() ? reason : RegionReason::named));
      CHECK(regions.arrays[0].held_vertices == 13);
      CHECK(regions.names == Names{"air", "steel"});
    }
  }
}

TEST_CASE("regions may be of any type of number, not-a-number included") {
  MeshDocument document = two_squares();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<float>{nan, nan, 0, 1.5F, 1.5F}));
  const Regions regions = regions_of(document);
  CHECK(regions.of_triangle == Numbers{1, 1, 0, 0});
  CHECK(regions.names == Names{"1.5", "nan"});
}

TEST_CASE("regions that differ beyond the digits of a double are two regions") {
  MeshDocument document = two_squares();
  const std::int64_t large = std::int64_t{1} << 53U;
  document.cell_arrays.push_back(
      make_data_array("region", 1, std::vector<std::int64_t>{large, large, 0, large + 1, large + 1}));
  CHECK(regions_of(document).of_triangle == Numbers{0, 0, 1, 1});
  CHECK(regions_of(document).names == Names{"9007199254740992", "9007199254740993"});
}

TEST_CASE("regions have the names that the file has for them, with the value where two have one name") {
  MeshDocument document = two_squares();
  document.cell_arrays.push_back(make_data_array("region", 1, std::vector<std::int32_t>{1, 2, 0, 3, 3}));
  const auto call = [&](std::vector<trismooth::ValueName> names) {
    trismooth::ArrayDescription description;
    description.value_names = std::move(names);
    document.cell_arrays.back().description = std::make_shared<trismooth::ArrayDescription>(std::move(description));
    return regions_of(document, {"region"}).names;
  };
  CHECK(call({{1, 2, "steel"}, {2, 2, "air"}, {3, 1, "wall"}}) == Names{"steel", "air", "3"});
  CHECK(call({{1, 2, "steel"}, {2, 2, "air"}, {3, 2, "steel"}}) == Names{"steel (1)", "air", "steel (3)"});
}

TEST_CASE("random regions on random meshes: what counts holds the ends of the edges where it changes") {
  test_meshes::Random random(11);
  for (int round = 0; round < 60; ++round) {
    const auto mesh = test_meshes::shuffled(
        test_meshes::jittered_grid(10 + random.below(8), 10 + random.below(8), 0.3, static_cast<std::uint64_t>(round)),
        static_cast<std::uint64_t>(round) + 100);
    MeshDocument document = triangle_document(mesh);
    // The nearest of a few seeds names the region.
    std::vector<trismooth::Point2<double>> seeds;
    for (std::int32_t i = 0; i < 2 + random.below(4); ++i) {
      seeds.push_back(mesh.points[static_cast<std::size_t>(random.below(mesh.vertex_count()))]);
    }
    Numbers values;
    for (const Triangle& t : mesh.triangles) {
      const auto p = mesh.points[static_cast<std::size_t>(t[0])];
      const auto nearest = std::ranges::min_element(
          seeds, {}, [&](auto s) { return (s.x - p.x) * (s.x - p.x) + (s.y - p.y) * (s.y - p.y); });
      values.push_back(static_cast<std::int32_t>(nearest - seeds.begin()) * 7);
    }
    const auto expected = interface_of(document, values);
    add(document, round % 2 == 0 ? "Subdomain ID" : "my parts", values);
    const Regions regions = regions_of(document);
    CAPTURE(round, seeds.size());
    if (expected.empty()) {
      continue;
    }
    REQUIRE(regions.arrays.size() == 1);
    CHECK(regions.arrays[0].held_vertices == static_cast<std::int64_t>(expected.size()));
    CHECK(interface_of(document, regions.of_triangle) == expected);
  }
}
