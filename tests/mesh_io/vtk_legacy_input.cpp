// SPDX-License-Identifier: BSD-3-Clause
// Dialects of legacy files that some programs write: a byte-order mark, comments, blanks at the ends of lines, SCALARS
// without a lookup table, strips. The same mesh is read, and the same bytes are written back.

#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_input.h"

#include "trismooth/mesh_io/mesh_file.h"

#include "vtk_legacy_files.h"

using legacy_test::TemporaryFile;
using trismooth::MeshDocument;

namespace dialects {

std::string plain(bool binary, const std::string& table = "LOOKUP_TABLE default\n", const std::string& count = " 1") {
  legacy_test::Builder file = legacy_test::grid_file(binary, false);
  file.text("POINT_DATA 9\nSCALARS height float" + count + "\n" + table);
  file.numbers(legacy_test::count_up<float>(9, 0.5, 1));
  file.text("CELL_DATA 7\nFIELD f 2\nregion 1 7 int\n").numbers(std::vector{1, 1, 1, 1, 2, 2, 2});
  file.text("second 2 7 short\n").numbers(legacy_test::count_up<std::int16_t>(14, 1, 1));
  return file.bytes();
}

/// The grid with cell data, as it is read.
MeshDocument with_cell_data(const std::string& attributes) {
  legacy_test::Builder file = legacy_test::grid_file(false, false);
  return trismooth::read_mesh(TemporaryFile(file.text("CELL_DATA 7\n" + attributes).bytes(), ".vtk").path());
}

/// The same mesh as in the plain file, and the same bytes when a coordinate has been moved away and back.
void check_same_mesh(const std::string& bytes, bool binary) {
  const MeshDocument expected = trismooth::read_mesh(TemporaryFile(plain(binary), ".vtk").path());
  const TemporaryFile source(bytes, ".vtk");
  MeshDocument document = trismooth::read_mesh(source.path());
  CHECK(document.points == expected.points);
  CHECK(document.cells.connectivity == expected.cells.connectivity);
  CHECK(document.cells.types == expected.cells.types);
  REQUIRE(document.point_arrays.size() == 1);
  REQUIRE(document.cell_arrays.size() == 2);
  CHECK(std::ranges::equal(document.point_arrays[0].bytes, expected.point_arrays[0].bytes));
  CHECK(std::ranges::equal(document.cell_arrays[0].bytes, expected.cell_arrays[0].bytes));
  CHECK(std::ranges::equal(document.cell_arrays[1].bytes, expected.cell_arrays[1].bytes));
  CHECK(document.cell_arrays[1].name == "second");
  document.points[12] = 0.8125;
  const TemporaryFile moved;
  trismooth::write_mesh(moved.path(), document);
  MeshDocument back = trismooth::read_mesh(moved.path());
  CHECK(back.points == document.points);
  back.points[12] = expected.points[12];
  const TemporaryFile again;
  trismooth::write_mesh(again.path(), back);
  const TemporaryFile unmoved;
  trismooth::write_mesh(unmoved.path(), trismooth::read_mesh(source.path()));
  CHECK(unmoved.bytes() == bytes);
  CHECK(trismooth::read_mesh(again.path()).points == expected.points);
}

/// `what` behind every line of text from `first` on.
std::string behind_lines(const std::string& bytes, bool binary, const std::string& what, int first) {
  std::string changed;
  int line_number = 0;
  std::size_t begin = 0;
  while (begin < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string line = bytes.substr(begin, end - begin);
    const bool is_text = !binary || line.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_") > 4;
    changed += line + (++line_number >= first && is_text ? what : "") + "\n";
    begin = end + 1;
  }
  return changed;
}

}  // namespace dialects

TEST_CASE("legacy VTK: a byte-order mark, blanks and comments change nothing") {
  const bool binary = GENERATE(false, true);
  const std::string plain = dialects::plain(binary);
  dialects::check_same_mesh("\xEF\xBB\xBF" + plain, binary);
  dialects::check_same_mesh(dialects::behind_lines(plain, binary, "  \t ", 1), binary);
  dialects::check_same_mesh(dialects::behind_lines(plain, binary, " # x 1 2 POINTS", 3), binary);
  dialects::check_same_mesh(dialects::behind_lines(plain, binary, "\t#", 3), binary);
  std::string with_lines = plain;
  for (const std::string keyword : {"\nDATASET", "\nPOINTS", "\nCELLS", "\nCELL_TYPES", "\nCELL_DATA", "\nFIELD"}) {
    const std::size_t at = with_lines.find(keyword);
    REQUIRE(at != std::string::npos);
    with_lines.insert(at, "\n# POINTS 3 float\n  # 1 2 3\n");
  }
  dialects::check_same_mesh(with_lines, binary);
}

TEST_CASE("legacy VTK: a name may begin with the mark of comments") {
  const std::string file =
      legacy_test::grid_file(false, false)
          .text(
              "CELL_DATA 7\nSCALARS #s int\nLOOKUP_TABLE #t\n1 2 3 4 5 6 7\nFIELD #f 1\n#a 1 7 int\n"
              "1 2 3 4 5 6 7 # end")
          .bytes();
  const TemporaryFile source(file, ".vtk");
  const MeshDocument document = trismooth::read_mesh(source.path());
  REQUIRE(document.cell_arrays.size() == 2);
  CHECK(document.cell_arrays[0].name == "#s");
  CHECK(document.cell_arrays[1].name == "#a");
}

TEST_CASE("legacy VTK: SCALARS may do without the lookup table and the number of components") {
  const bool binary = GENERATE(false, true);
  for (const std::string count : {"", " 1"}) {
    CAPTURE(binary, count);
    dialects::check_same_mesh(dialects::plain(binary, "", count), binary);
    dialects::check_same_mesh(dialects::plain(binary, "", count + "  "), binary);
    dialects::check_same_mesh(dialects::plain(binary, "LOOKUP_TABLE default\n", count), binary);
  }
  // The number of components in a line of its own, as VTK reads it.
  dialects::check_same_mesh(dialects::plain(binary, "1\nLOOKUP_TABLE default\n", ""), binary);
  const MeshDocument document = dialects::with_cell_data("SCALARS s int 2\n1 2 3 4 5 6 7 8 9 10 11 12 13 14\n");
  REQUIRE(document.cell_arrays.size() == 1);
  CHECK(document.cell_arrays[0].components == 2);
  CHECK(document.cell_arrays[0].value(6, 1) == 14);
}

TEST_CASE("legacy VTK: METADATA goes with its array, and what is no METADATA ends it") {
  const MeshDocument document = dialects::with_cell_data(
      "VECTORS v int\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 3\n"
      "METADATA\nCOMPONENT_NAMES\nx%20y  \n\nz\n"
      "INFORMATION 2\nNAME UNITS_LABEL LOCATION vtkDataArray\nDATA m\n"
      "NAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n  \n"
      "SCALARS s int\nLOOKUP_TABLE default\n1 2 3 4 5 6 7\n");
  REQUIRE(document.cell_arrays.size() == 2);
  const auto& description = document.cell_arrays[0].description;
  REQUIRE(description != nullptr);
  CHECK(description->component_names == std::vector<std::string>{"x y", "", "z"});
  REQUIRE(description->information.size() == 1);
  CHECK(description->information[0] == trismooth::ArrayInformation{"UNITS_LABEL", "vtkDataArray", {"m"}});
  CHECK(description->roles == std::vector<std::string>{"Vectors"});
  CHECK(document.cell_arrays[1].description->roles == std::vector<std::string>{"Scalars"});
}

TEST_CASE("legacy VTK: of two lists of names of components the last one holds, as many names as components") {
  const MeshDocument document = dialects::with_cell_data(
      "SCALARS pair int 2\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10 11 12 13 14\n"
      "METADATA\nCOMPONENT_NAMES\nold\nnames\nCOMPONENT_NAMES\nnew\nones\n\n");
  REQUIRE(document.cell_arrays.size() == 1);
  REQUIRE(document.cell_arrays[0].description != nullptr);
  CHECK(document.cell_arrays[0].description->component_names == std::vector<std::string>{"new", "ones"});
}
