// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_annotations.h"

#include <string>
#include <vector>

#include "trismooth/mesh_io/annotation_names.h"

#include "vtk_legacy_files.h"

using namespace legacy_test;
using trismooth::AddedArrays;
using trismooth::DataArray;
using trismooth::find_array;
using trismooth::is_annotation;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::write_mesh;

namespace {

AddedArrays annotations(double value) {
  AddedArrays added;
  added.point_arrays = {make_data_array("trismooth:fixed", 1, std::vector<std::uint8_t>(9, 1)),
                        make_data_array("trismooth:displacement", 3, std::vector<double>(27, value))};
  added.cell_arrays = {make_data_array("trismooth:shape", 1, std::vector<double>(7, value))};
  return added;
}

/// The bytes that the file becomes when it is read and written with these arrays, which VTK has to read as we do.
std::string annotated(const std::string& bytes, const AddedArrays& added) {
  const TemporaryFile source(bytes, ".vtk");
  const TemporaryFile target;
  write_mesh(target.path(), read_mesh(source.path()), added);
  check_same(read_mesh(target.path()), read_with_vtk(target.path()));
  return target.bytes();
}

using Files = std::vector<std::pair<std::string, std::string>>;

/// Files of a user's, with arrays of the names that annotations have after their prefix.
Files own_files(bool binary) {
  const auto scalars = [](Builder& file, std::size_t rows, const std::string& name) {
    file.text("SCALARS " + name + " double\nLOOKUP_TABLE default\n").numbers(std::vector<double>(rows, 0.25));
  };
  Files files{{"no data", grid_file(binary, true).bytes()}};
  Builder points = grid_file(binary, false);
  points.text("POINT_DATA 9\n");
  scalars(points, 9, "fixed");
  files.emplace_back("point data", points.bytes());
  Builder cells = grid_file(binary, true);
  cells.text("CELL_DATA 7\n");
  scalars(cells, 7, "shape");
  files.emplace_back("cell data", cells.bytes());
  Builder both = cells;
  both.text("POINT_DATA 9\n");
  scalars(both, 9, "fixed");
  files.emplace_back("cell data before point data", both.bytes());
  Builder all = grid_file(binary, false);
  all.text("POINT_DATA 9\n");
  add_attributes(all, 9, binary, "p_");
  all.text("CELL_DATA 7\n");
  add_attributes(all, 7, binary, "c_");
  files.emplace_back("every kind of attribute", all.bytes());
  Builder metadata = cells;
  metadata.text("METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n");
  files.emplace_back("metadata", metadata.bytes());
  return files;
}

/// Files with annotations as VTK's and others' writers leave them, where they are asked to write what we wrote.
Files rewritten_files(bool binary) {
  Files files;
  Builder active = grid_file(binary, true);
  active.text("CELL_DATA 7\nSCALARS trismooth:shape double\nLOOKUP_TABLE default\n");
  active.numbers(std::vector<double>(7, 0.5)).text("SCALARS mine double\nLOOKUP_TABLE default\n");
  active.numbers(std::vector<double>(7, 3)).text("POINT_DATA 9\nVECTORS trismooth:displacement double\n");
  active.numbers(std::vector<double>(27, 0.5));
  files.emplace_back("attributes", active.bytes());
  Builder field = grid_file(binary, false);
  field.text("POINT_DATA 9\nFIELD FieldData 4\ntrismooth:fixed 1 9 unsigned_char\n");
  field.numbers(std::vector<std::uint8_t>(9, 7)).text("mine 2 9 double\n").numbers(count_up<double>(18, 0, 0.1));
  field.text("trismooth:displacement 3 9 double\n").numbers(std::vector<double>(27, 0.5));
  field.text("METADATA\nCOMPONENT_NAMES\nx\ny\nz\n\n");
  field.text("yours 1 9 int\n").numbers(count_up<std::int32_t>(9, 0, 1));
  field.text("CELL_DATA 7\nFIELD FieldData 1\ntrismooth:shape 1 7 double\n").numbers(std::vector<double>(7, 0.5));
  files.emplace_back("in the midst of a field", field.bytes());
  return files;
}

}  // namespace

TEST_CASE("legacy VTK: annotations replace those of an earlier run and nothing else") {
  const bool binary = GENERATE(false, true);
  Files files = own_files(binary);
  for (auto& file : rewritten_files(binary)) {
    files.push_back(file);
  }
  for (const auto& [name, bytes] : files) {
    CAPTURE(binary, name);
    const TemporaryFile source(bytes, ".vtk");
    MeshDocument expected = read_mesh(source.path());
    for (auto* const arrays : {&expected.point_arrays, &expected.cell_arrays}) {
      std::erase_if(*arrays, [](const DataArray& array) { return is_annotation(array.name); });
    }
    const AddedArrays second = annotations(0.75);
    expected.point_arrays.insert(expected.point_arrays.end(), second.point_arrays.begin(), second.point_arrays.end());
    expected.cell_arrays.insert(expected.cell_arrays.end(), second.cell_arrays.begin(), second.cell_arrays.end());
    const TemporaryFile twice(annotated(annotated(bytes, annotations(0.5)), second), ".vtk");
    check_same(expected, read_with_vtk(twice.path()));
  }
}

TEST_CASE("legacy VTK: annotating twice gives the bytes that annotating once gives") {
  const bool binary = GENERATE(false, true);
  for (const auto& [name, bytes] : own_files(binary)) {
    CAPTURE(binary, name);
    const std::string once = annotated(bytes, annotations(0.75));
    CHECK(once.substr(0, bytes.size()) == bytes);
    CHECK(annotated(annotated(bytes, annotations(-1.5)), annotations(0.75)) == once);
  }
}

TEST_CASE("legacy VTK: annotations stay where none is added") {
  const bool binary = GENERATE(false, true);
  for (const auto& [name, bytes] : rewritten_files(binary)) {
    CAPTURE(binary, name);
    CHECK(annotated(bytes, {}) == bytes);
  }
}

TEST_CASE("legacy VTK: a file without a last line end does not grow with every run") {
  std::string bytes = own_files(false)[1].second;
  bytes.pop_back();
  const std::string twice = annotated(annotated(bytes, annotations(1)), annotations(1));
  CHECK(annotated(twice, annotations(1)) == twice);
}
