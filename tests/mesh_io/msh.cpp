// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/mesh_io/bytes/file_workers.h"
#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/msh/msh_affine_map.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_tags.h"

#include "catch.h"
#include "support/accepted_msh_files.h"
#include "support/memory_file.h"
#include "support/readings.h"
#include "support/text_format.h"

namespace trismooth::msh_test {

MeshDocument read_msh_text(const std::string& bytes) {
  return msh_codec.read("plate.msh", bytes);
}

std::string msh_error(const std::string& bytes) {
  try {
    read_msh_text(bytes);
  } catch (const trismooth::ReadError& error) {
    return error.what();
  }
  return "no error";
}

std::string written_back(const MeshDocument& document) {
  const test_support::MemoryFile file;
  document.original->write(file.path(), document, {}, {});
  return file.bytes();
}

std::string written_as_msh(const MeshDocument& document) {
  const test_support::MemoryFile file;
  msh_codec.write(file.path(), document);
  return file.bytes();
}

std::string with_added_arrays(const MeshDocument& document, const std::vector<DataArray>& of_points,
                              const std::vector<DataArray>& of_cells) {
  const test_support::MemoryFile file;
  document.original->write(file.path(), document, of_points, of_cells);
  return file.bytes();
}

std::vector<double> numbers_of(const std::vector<DataArray>& arrays, const std::string& name) {
  const DataArray* const array = find_array(arrays, name);
  std::vector<double> numbers;
  for (std::size_t row = 0; array != nullptr && row < array->rows(); ++row) {
    numbers.push_back(array->value(row));
  }
  return numbers;
}

std::string replaced_in(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

using Numbers = std::vector<double>;

TEST_CASE("every version of MSH, as text and binary, gives the same cells, groups and names") {
  for (const int version : {20, 21, 22, 40, 41}) {
    for (const bool binary : {false, true}) {
      for (const bool big : {false, true}) {
        CAPTURE(version, binary, big);
        const MeshDocument document = read_msh_text(accepted_files::msh::file(
            {.version = version, .binary = binary, .big_endian = big, .with_groups = true, .with_data = true}));
        CHECK(document.points == Numbers{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.75, 1.25, 0});
        CHECK(document.cells.types == std::vector<std::uint8_t>{3, 3, 3, 5, 5, 5, 5});
        CHECK(document.cells.connectivity ==
              std::vector<std::int32_t>{0, 1, 1, 2, 2, 3, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
        CHECK(numbers_of(document.cell_arrays, "gmsh:physical") == Numbers{5, 5, 5, 1, 1, 2, 2});
        CHECK(numbers_of(document.cell_arrays, "gmsh:geometrical") == Numbers{1, 1, 1, 1, 1, 2, 2});
        CHECK(find_array(document.cell_arrays, "gmsh:physical")->description->value_names ==
              std::vector<trismooth::ValueName>{{5, 1, "the edge"}, {1, 2, "steel"}, {2, 2, "all"}});
        REQUIRE(document.cell_sets.size() == 1);
        CHECK(document.cell_sets[0] == trismooth::NamedSet{"all", {3, 4, 5, 6}});
        CHECK(numbers_of(document.point_arrays, "heat \"a\"") == Numbers{1, 2, 3, 4, 5});
        CHECK(find_array(document.point_arrays, "data")->components == 3);
      }
    }
  }
}

TEST_CASE("names of version 2.0 have no dimension, and are of those in which their group has elements") {
  const std::string text =
      "$MeshFormat\n2.0 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n7 \"wall\"\n8 \"1 fluid\"\n9 \"none\"\n"
      "$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
      "$Elements\n3\n1 1 2 7 1 1 2\n2 1 2 8 1 2 3\n3 2 2 8 1 1 2 3\n$EndElements\n";
  const MeshDocument document = read_msh_text(text);
  CHECK(find_array(document.cell_arrays, "gmsh:physical")->description->value_names ==
        std::vector<trismooth::ValueName>{{7, 1, "wall"}, {8, 1, "1 fluid"}, {8, 2, "1 fluid"}, {9, 2, "none"}});
  CHECK(written_back(document) == text);
}

TEST_CASE("parts of a partitioned surface are of that surface, and their numbers are told") {
  for (const int version : {22, 40, 41}) {
    const MeshDocument document = read_msh_text(accepted_files::msh::file({.version = version, .partitioned = true}));
    CAPTURE(version);
    CHECK(numbers_of(document.cell_arrays, "gmsh:geometrical") == Numbers{1, 1, 1, 1, 1, 2, 2});
    CHECK(numbers_of(document.cell_arrays, "gmsh:partition").back() == 2);
  }
}

TEST_CASE("MSH is written back with the moved coordinates and values of fields, all else is as it was") {
  const std::string text = accepted_files::msh::file({.with_data = true});
  MeshDocument document = read_msh_text(text);
  CHECK(written_back(document) == text);
  document.points[12] = 0.875;
  CHECK(written_back(document) == replaced_in(text, "0.75 1.25 0\n", "0.875 1.25 0\n"));
  CHECK(document.original->keeps_values_of("data"));
  CHECK_FALSE(document.original->keeps_values_of("stress"));
  std::vector<double> heat{1, 2, 3, 4, 5.5};
  *std::ranges::find(document.point_arrays, "heat \"a\"", &DataArray::name) =
      trismooth::make_data_array("heat \"a\"", 1, heat);
  CHECK(written_back(document) ==
        replaced_in(replaced_in(text, "0.75 1.25 0\n", "0.875 1.25 0\n"), "\n5 5\n", "\n5 5.5\n"));
}

TEST_CASE("arrays are added behind the last section of an MSH file, whose bytes stay, and replaced the next time") {
  for (const int version : {20, 21, 22, 40, 41}) {
    for (const bool binary : {false, true}) {
      for (const bool big : {false, true}) {
        CAPTURE(version, binary, big);
        const std::string bytes = accepted_files::msh::file({.version = version,
                                                             .binary = binary,
                                                             .big_endian = big,
                                                             .with_groups = true,
                                                             .with_data = true,
                                                             .sparse = true});
        const MeshDocument document = read_msh_text(bytes);
        REQUIRE(document.original->takes_added_arrays());
        const Numbers shapes{0, 0, 0, 0.25, 1e-300, 1, 1e30};
        const std::vector<DataArray> of_points{
            trismooth::make_data_array("trismooth:fixed", 1, std::vector<std::uint8_t>{1, 1, 1, 0, 1}),
            trismooth::make_data_array("data", 3, Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 0.1})};
        const std::vector<DataArray> of_cells{trismooth::make_data_array("trismooth:shape", 1, shapes)};
        const std::string once = with_added_arrays(document, of_points, of_cells);
        CHECK(once.starts_with(bytes));
        const MeshDocument again = read_msh_text(once);
        CHECK(numbers_of(again.cell_arrays, "trismooth:shape") == shapes);
        CHECK(numbers_of(again.point_arrays, "trismooth:fixed") == Numbers{1, 1, 1, 0, 1});
        // The file's own array of that name keeps it.
        CHECK(numbers_of(again.point_arrays, "data") == numbers_of(document.point_arrays, "data"));
        const DataArray* const renamed = find_array(again.point_arrays, "data_1");
        REQUIRE(renamed != nullptr);
        CHECK(renamed->value(4, 2) == 0.1);
        const std::vector<DataArray> fixed{of_points[0]};
        CHECK(with_added_arrays(read_msh_text(with_added_arrays(document, fixed, of_cells)), fixed, of_cells) ==
              with_added_arrays(document, fixed, of_cells));
        CHECK(with_added_arrays(read_msh_text(with_added_arrays(document, fixed, of_cells)), {}, of_cells) ==
              with_added_arrays(document, {}, of_cells));
      }
    }
  }
}

TEST_CASE("no arrays are added to what has no place for them: version 1, and files with tags beyond 32 bits") {
  const std::vector<DataArray> fixed{
      trismooth::make_data_array("trismooth:fixed", 1, std::vector<std::uint8_t>{1, 1, 1, 1})};
  const MeshDocument of_version_1 = read_msh_text(
      "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$ENDNOD\n"
      "$ELM\n2\n1 2 1 1 3 1 2 3\n2 2 1 1 3 2 4 3\n$ENDELM\n");
  CHECK_FALSE(of_version_1.original->takes_added_arrays());
  CHECK_THROWS_AS(with_added_arrays(of_version_1, fixed, {}), trismooth::WriteError);
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 9999999999\n2 1 0 4\n1\n2\n3\n9999999999\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n$EndNodes\n$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 2 9999999999 3\n$EndElements\n";
  CHECK_FALSE(read_msh_text(text).original->takes_added_arrays());
  CHECK(read_msh_text(replaced_in(replaced_in(replaced_in(text, "9999999999", "9"), "\n9999999999\n", "\n9\n"),
                                  "2 9999999999 3", "2 9 3"))
            .original->takes_added_arrays());
}

TEST_CASE("parametric coordinates follow their nodes on plane surfaces") {
  const std::string nodes = "0 0 0 1 10\n1 0 0 1 12\n0 1 0 4 10\n0.5 0.25 0 1.75 11\n";
  const std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 1 4\n1\n2\n3\n4\n" + nodes +
                           "$EndNodes\n$Elements\n1 3 1 3\n2 1 2 3\n1 1 2 4\n2 2 3 4\n3 3 1 4\n$EndElements\n";
  MeshDocument document = read_msh_text(text);
  document.points[9] = 0.25;
  CHECK(document.notes.empty());
  CHECK(written_back(document) == replaced_in(text, "0.5 0.25 0 1.75 11\n", "0.25 0.25 0 1.75 10.5\n"));
}

TEST_CASE("parametric coordinates of a curved surface are left out where a node of it moves") {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 1 4\n1\n2\n3\n4\n"
      "0 0 0 1 10\n1 0 0 1 12\n0 1 0 4 10\n0.5 0.25 0 3 11\n"
      "$EndNodes\n$Elements\n1 3 1 3\n2 1 2 3\n1 1 2 4\n2 2 3 4\n3 3 1 4\n$EndElements\n";
  MeshDocument document = read_msh_text(text);
  CHECK(document.notes.size() == 1);
  CHECK(written_back(document) == text);
  document.points[9] = 0.25;
  CHECK(written_back(document) ==
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n"
        "0 0 0\n1 0 0\n0 1 0\n0.25 0.25 0\n"
        "$EndNodes\n$Elements\n1 3 1 3\n2 1 2 3\n1 1 2 4\n2 2 3 4\n3 3 1 4\n$EndElements\n");
  // The same in every version and encoding: what is left is read as what it was.
  for (const int version : {10, 22, 40, 41}) {
    for (const bool binary : {false, true}) {
      if (version == 10 && binary) {
        continue;  // version 1 is text
      }
      CAPTURE(version, binary);
      MeshDocument other =
          read_msh_text(accepted_files::msh::file({.version = version, .binary = binary, .parametric = true}));
      other.points[12] = 0.5;
      const MeshDocument again = read_msh_text(written_back(other));
      CHECK(again.points == other.points);
      CHECK(again.cells.connectivity == other.cells.connectivity);
    }
  }
}

TEST_CASE("nodes of points and curves, and linked ones, are implied sets in every version that tells them") {
  for (const int version : {40, 41}) {
    for (const bool binary : {false, true}) {
      CAPTURE(version, binary);
      const MeshDocument document = read_msh_text(accepted_files::msh::file({.version = version, .binary = binary}));
      CHECK(document.implied_sets == std::vector<trismooth::NamedSet>{{"gmsh:curves", {0, 1, 2, 3}}});
    }
  }
  CHECK(read_msh_text(accepted_files::msh::file({.version = 22})).implied_sets.empty());
  // Of $ParametricNodes, and of $NOD with parameters.
  for (const int version : {10, 22}) {
    const MeshDocument document = read_msh_text(accepted_files::msh::file({.version = version, .parametric = true}));
    CHECK(document.implied_sets == std::vector<trismooth::NamedSet>{{"gmsh:points", {0}}, {"gmsh:curves", {1, 2, 3}}});
  }
  // Where all nodes are of curves, the file does not mean it.
  const std::string text = accepted_files::msh::file({});
  CHECK(read_msh_text(replaced_in(text, "\n2 1 0 1\n", "\n1 1 0 1\n")).implied_sets.empty());
  const trismooth::NamedSet linked{"gmsh:periodic", {0, 1, 4}};
  CHECK(read_msh_text(text + "$Periodic\n1\n1 2 1\n3 1 0.5 -1\n2\n1 2\n5 2\n$EndPeriodic\n").implied_sets.back() ==
        linked);
  using Pairs = std::vector<std::array<std::int32_t, 2>>;
  CHECK(read_msh_text(text + "$Periodic\n1\n1 2 1\n3 1 0.5 -1\n2\n1 2\n5 2\n$EndPeriodic\n").periodic_pairs ==
        Pairs{{0, 1}, {4, 1}});
  for (const char* const map : {"", "Affine 1 0 0 2 0 1 0\n"}) {
    // Gmsh writes 0 for nodes that it leaves out.
    const std::string section =
        "$Periodic\n2\n1 2 1\n" + std::string(map) + "2\n1 2\n0 2\n1 2 1\n1\n5 1\n$EndPeriodic\n";
    CHECK(read_msh_text(accepted_files::msh::file({.version = 40}) + section).implied_sets.back() == linked);
    CHECK(read_msh_text(accepted_files::msh::file({.version = 22}) + section).implied_sets.back() == linked);
    CHECK(read_msh_text(accepted_files::msh::file({.version = 22}) + section).periodic_pairs == Pairs{{0, 1}, {4, 0}});
    CHECK(read_msh_text(accepted_files::msh::file({.version = 22, .binary = true}) + section).implied_sets.back() ==
          linked);
  }
  // What is not understood is kept, and said.
  const std::string odd = text + "$Periodic\n1\nof my own\n$EndPeriodic\n";
  const MeshDocument document = read_msh_text(odd);
  CHECK(document.implied_sets.size() == 1);
  CHECK(document.notes.front() == "The section $Periodic is not understood, so it holds no nodes.");
  CHECK(written_back(document) == odd);
}

TEST_CASE("what is wrong in an MSH file is said with its line") {
  const std::string text = accepted_files::msh::file({});
  const auto with = [&text](const std::string& what, const std::string& instead) {
    return msh_error(replaced_in(text, what, instead));
  };
  CHECK(with("4.1 0 8", "3 0 8").starts_with("plate.msh:2: expected a version of the format"));
  CHECK(with("1 1 2\n2 2 3", "1 1 9\n2 2 3").ends_with("the element refers to node 9, which the file does not have"));
  CHECK(with("\n1\n2\n3\n4\n", "\n1\n2\n3\n2\n").find("is that of another one before it") != std::string::npos);
  CHECK(with("0.75 1.25 0", "0.75 nan 0").find("expected a coordinate (a finite number), got 'nan'") !=
        std::string::npos);
  CHECK(with("$EndNodes", "$EndNods").find("expected $EndNodes, got '$EndNods'") != std::string::npos);
  CHECK(with("1 1 1 3\n", "1 1 35 3\n").find("elements of type 35 are not supported") != std::string::npos);
  CHECK(with("$Elements\n3 7", "$Elements\n3 99").find("has room for") != std::string::npos);
  CHECK(msh_error("hello\n") == "plate.msh:1: is not an MSH file: expected $MeshFormat, got 'hello'");
}

TEST_CASE("tags beyond what a version holds are refused, and said to be so by readers in parts of any size") {
  trismooth::Workers alone(1);
  const auto reading = [&alone](const std::string& bytes, std::size_t part_bytes) {
    return test_support::reading_of(msh_codec, bytes, trismooth::FileWorkers(alone, part_bytes));
  };
  const std::string range = " from 0 to 2147483647, got '4294967296'";
  for (const int version : {10, 20, 22, 40}) {
    const std::string text = accepted_files::msh::file({.version = version, .with_data = version >= 20});
    const auto with = [&text](const std::string& what) {
      // 2 in the lowest bits: what a narrow tag would be.
      return replaced_in(text, what, "\n4294967296" + what.substr(2));
    };
    for (const std::string& damaged : {with("\n2 2 0 0\n"), with(version == 40 ? "\n4 1 2 5\n" : "\n4 2 ")}) {
      INFO(damaged);
      const std::string refusal = reading(damaged, trismooth::FileWorkers::serial);
      CHECK(refusal.find("the tag of a") != std::string::npos);
      CHECK(refusal.ends_with(range));
      for (const std::size_t part_bytes : {std::size_t{1}, std::size_t{40}, trismooth::FileWorkers::whole}) {
        CHECK(reading(damaged, part_bytes) == refusal);
      }
    }
  }
  const std::string text = accepted_files::msh::file({.version = 41});
  const std::string wide = replaced_in(text, "\n1\n2\n3\n4\n", "\n1\n4294967296\n3\n4\n");
  CHECK(reading(wide, 1).find("refers to node 2, which the file does not have") != std::string::npos);
}

TEST_CASE("a document from elsewhere becomes an MSH file with entities for its groups") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  document.cells.append(3, std::vector{0, 1});
  document.cells.append(5, std::vector{0, 1, 2});
  document.cells.append(5, std::vector{0, 2, 3});
  DataArray regions = trismooth::make_data_array("medit:ref", 1, std::vector<std::int32_t>{4, 7, 9});
  regions.description = std::make_shared<trismooth::ArrayDescription>(
      trismooth::ArrayDescription{{}, {}, {{4, 1, "wall"}, {9, 2, "steel"}}, {}});
  document.cell_arrays.push_back(regions);
  document.cell_sets.push_back({"half", {1}});
  document.point_arrays.push_back(trismooth::make_data_array("u", 2, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(written_as_msh(document) ==
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
        "$PhysicalNames\n3\n1 4 \"wall\"\n2 9 \"steel\"\n2 10 \"half\"\n$EndPhysicalNames\n"
        "$Entities\n0 1 2 0\n1 0 0 0 1 0 0 1 4 0\n1 0 0 0 1 1 0 2 7 10 0\n2 0 0 0 1 1 0 1 9 0\n$EndEntities\n"
        "$Nodes\n3 4 1 4\n1 1 0 2\n1\n2\n0 0 0\n1 0 0\n2 1 0 1\n3\n1 1 0\n2 2 0 1\n4\n0 1 0\n$EndNodes\n"
        "$Elements\n3 3 1 3\n1 1 1 1\n1 1 2\n2 1 2 1\n2 1 2 3\n2 2 2 1\n3 1 3 4\n$EndElements\n"
        "$NodeData\n1\n\"u\"\n1\n0\n3\n0\n3\n4\n1 1 2 0\n2 3 4 0\n3 5 6 0\n4 7 8 0\n$EndNodeData\n");
  CHECK(msh_codec.what_is_lost(document) ==
        std::vector<std::string>{"MSH holds fields of 1, 3 or 9 numbers: u gets a third one, 0"});
  const MeshDocument again = read_msh_text(written_as_msh(document));
  CHECK(again.points == document.points);
  CHECK(again.cells.connectivity == document.cells.connectivity);
  CHECK(numbers_of(again.cell_arrays, "gmsh:physical") == Numbers{4, 7, 9});
  CHECK(again.cell_sets == document.cell_sets);
}

TEST_CASE("names of groups with quotation marks are changed, stay apart from each other, and are told") {
  MeshDocument document;
  document.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (int i = 0; i < 4; ++i) {
    document.cells.append(trismooth::cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  }
  document.cell_sets = {{"a_b", {0}}, {"a\"b", {1}}, {"a\nb", {2}}, {"plain", {3}}};
  const MeshDocument read = read_msh_text(written_as_msh(document));
  std::vector<std::string> names;
  for (const trismooth::ValueName& name : find_array(read.cell_arrays, "gmsh:physical")->description->value_names) {
    names.push_back(name.name);
  }
  CHECK(names == std::vector<std::string>{"a_b", "a_b_1", "a_b_2", "plain"});
  CHECK(
      msh_codec.what_is_lost(document) ==
      std::vector<std::string>{"MSH holds names without quotation marks: changed are 'a\"b' (as a_b_1), 'a\\x0ab' (as "
                               "a_b_2)"});
  document.cell_sets = {{"plain", {0, 1, 2, 3}}};
  CHECK(msh_codec.what_is_lost(document).empty());
  document.cell_sets = {{"plain", {3}}};
  CHECK(msh_codec.what_is_lost(document) ==
        std::vector<std::string>{"MSH drops what is in no physical group where any is, once Gmsh saves it again: "
                                 "surfaces without a group are written in a further one, 2"});
  const MeshDocument all_in_groups = read_msh_text(written_as_msh(document));
  CHECK(values_of<std::int32_t>(all_in_groups.cell_arrays, "gmsh:physical") == std::vector<std::int32_t>{2, 2, 2, 1});
}

TEST_CASE("tags of any kind are found, and those given twice") {
  trismooth::MshTags tags;
  tags.add(std::vector<std::int64_t>{7, 8, 9, 1000000000000, 3, 4});
  tags.add_run(20, 3);
  CHECK_FALSE(tags.finish());
  CHECK(tags.size() == 9);
  CHECK(tags.find(8) == 1);
  CHECK(tags.find(1000000000000) == 3);
  CHECK(tags.find(4) == 5);
  CHECK(tags.find(22) == 8);
  for (const std::int64_t missing : {0LL, 5LL, 10LL, 23LL, 999999999999LL, 1000000000001LL}) {
    CHECK(tags.find(missing) == -1);
  }
  trismooth::MshTags twice;
  twice.add(std::vector<std::int64_t>{5, 6, 7, 2, 6});
  CHECK(twice.finish() == 4U);
}

TEST_CASE("elements keep their vertices in VTK's order, and faces without a type of VTK are polygons") {
  for (std::int64_t number = 1; number <= 140; ++number) {
    const trismooth::MshElementType& type = trismooth::msh_element_type(number);
    CAPTURE(number);
    std::vector<std::uint16_t> order = type.order;
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i) {
      CHECK(order[i] == i);
    }
    CHECK((order.empty() || order.size() == type.vertices));
  }
  using Order = std::vector<std::uint16_t>;
  CHECK(trismooth::msh_element_type(20).order == Order{0, 3, 4, 1, 5, 6, 2, 7, 8});
  CHECK(trismooth::msh_element_type(36).order == Order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8, 11, 10, 12, 13, 15, 14});
  CHECK(trismooth::msh_number_of(5, 3) == 2);
  CHECK(trismooth::msh_number_of(7, 4) == 3);
  CHECK(trismooth::msh_number_of(7, 5) == 0);
}

TEST_CASE("an affine map is found on planes, not on curved surfaces nor on points of one line") {
  using trismooth::MshAffineMap;
  const Numbers plane{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const auto map = MshAffineMap::find(plane, Numbers{0, 5, 2, 5, 0, 6, 2, 6}, 2);
  REQUIRE(map);
  CHECK(map->change({0.5, 0, 0}, 0) == Approx(1));
  CHECK(map->change({0, 0.5, 0}, 1) == Approx(0.5));
  CHECK_FALSE(MshAffineMap::find(plane, Numbers{0, 5, 2, 5, 0, 6, 3, 6}, 2));
  CHECK_FALSE(MshAffineMap::find(Numbers{0, 0, 0, 1, 0, 0, 2, 0, 0}, Numbers{0, 0, 1, 0, 2, 0}, 2));
  CHECK(MshAffineMap::find(Numbers{0, 0, 0, 1, 0, 0, 2, 0, 0}, Numbers{0, 1, 2}, 1));
}

}  // namespace trismooth::msh_test
