// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_writer.h"

#include <cmath>
#include <filesystem>
#include <random>
#include <span>

#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"

#include "vtk_legacy_files.h"

using namespace legacy_test;
using trismooth::AddedArrays;
using trismooth::DataArray;
using trismooth::find_array;
using trismooth::make_data_array;
using trismooth::MeshDocument;
using trismooth::read_mesh;
using trismooth::ScalarType;
using trismooth::write_mesh;

namespace {

/// A grid with attributes behind it; `ending` says in which section the file ends, and how.
std::string file_with_ending(bool binary, bool poly_data, const std::string& ending) {
  Builder file = grid_file(binary, false);
  std::size_t cells = 7;
  if (poly_data) {
    file = Builder(binary, "3.0", "POLYDATA");
    file.text("POINTS 9 double\n").numbers(grid_points());
    file.cells("POLYGONS", {{0, 1, 4}, {0, 4, 3}}, false);
    cells = 2;
  }
  const auto scalars = [&](const std::string& section, std::size_t rows) {
    file.text(section + " " + std::to_string(rows) + "\nSCALARS shape double\nLOOKUP_TABLE default\n");
    file.numbers(std::vector<double>(rows, 0.25));
  };
  if (ending == "points" || ending == "cells then points" || ending == "metadata" || ending == "no line end") {
    if (ending == "cells then points") {
      scalars("CELL_DATA", cells);
    }
    scalars("POINT_DATA", 9);
    if (ending == "metadata") {
      file.text("METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1");
    }
  } else if (ending == "cells" || ending == "points then cells") {
    if (ending == "points then cells") {
      scalars("POINT_DATA", 9);
    }
    scalars("CELL_DATA", cells);
  } else if (ending == "strings") {
    file.text("CELL_DATA " + std::to_string(cells) + "\nFIELD f 1\nshape 1 " + std::to_string(cells) + " string\n");
    for (std::size_t i = 0; i < cells; ++i) {
      file.text(binary ? "\xc1s" : i == 0 ? "s" : "\ns");
    }
  }
  std::string bytes = file.bytes();
  if (ending == "no line end") {
    bytes.pop_back();
  }
  return bytes;
}

/// Values that are hard to write: extremes, the smallest, the longest.
template <class T>
DataArray hard_values(const std::string& name, std::size_t rows, std::size_t components) {
  std::mt19937_64 random(7);
  std::vector<T> values{std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max(), std::numeric_limits<T>::min(),
                        T(0)};
  if constexpr (std::is_floating_point_v<T>) {
    values.insert(values.end(), {-T(0), std::numeric_limits<T>::denorm_min(), T(1) / 3, T(1e22)});
  }
  values.resize(rows * components);
  for (std::size_t i = 8; i < values.size(); ++i) {
    if constexpr (std::is_floating_point_v<T>) {
      values[i] = static_cast<T>(std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 100) - 80));
    } else {
      values[i] = static_cast<T>(random());
    }
  }
  return make_data_array(name, components, std::move(values));
}

std::vector<DataArray> arrays_of_every_type(std::size_t rows) {
  return {hard_values<std::int8_t>("int 8", rows, 2),     hard_values<std::uint8_t>("uint8", rows, 1),
          hard_values<std::int16_t>("100%", rows, 1),     hard_values<std::uint16_t>("\"uint16\"", rows, 3),
          hard_values<std::int32_t>("int32", rows, 1),    hard_values<std::uint32_t>("uint32\n", rows, 1),
          hard_values<std::int64_t>("\xc3\xa9", rows, 1), hard_values<std::uint64_t>("metadata", rows, 2),
          hard_values<float>("NULL_ARRAY", rows, 3),      hard_values<double>("%41", rows, 9)};
}

MeshDocument document_from_scratch(ScalarType point_type) {
  MeshDocument document;
  document.point_type = point_type;
  const DataArray values =
      point_type == ScalarType::float32 ? hard_values<float>("", 20, 3) : hard_values<double>("", 20, 3);
  for (std::size_t row = 0; row < 20; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      document.points.push_back(values.value(row, axis));
    }
  }
  for (std::size_t cell = 0; cell < grid_cells().size(); ++cell) {
    const std::vector<std::int32_t> vertices(grid_cells()[cell].begin(), grid_cells()[cell].end());
    document.cells.append(static_cast<std::uint8_t>(grid_types()[cell]), vertices);
  }
  document.cells.append(trismooth::cell_type::poly_vertex, std::vector<std::int32_t>{19, 18, 17});
  document.point_arrays = arrays_of_every_type(20);
  document.cell_arrays = arrays_of_every_type(8);
  document.field_arrays = arrays_of_every_type(33);
  document.field_arrays.push_back(make_data_array("empty", 1, std::vector<double>{}));
  return document;
}

}  // namespace

TEST_CASE("legacy VTK: VTK finds the arrays that were added, and all others, whatever the file ends in") {
  const bool binary = GENERATE(false, true);
  const bool poly_data = GENERATE(false, true);
  const std::string ending = GENERATE(as<std::string>(), "none", "points", "cells", "points then cells",
                                      "cells then points", "metadata", "strings", "no line end");
  CAPTURE(binary, poly_data, ending);
  const TemporaryFile source(file_with_ending(binary, poly_data, ending), ".vtk");
  const MeshDocument document = read_mesh(source.path());
  AddedArrays added;
  added.point_arrays = {hard_values<double>("displacement", 9, 3), hard_values<std::uint8_t>("shape", 9, 1)};
  added.cell_arrays = {hard_values<double>("shape", document.cells.size(), 1)};
  const TemporaryFile target;
  write_mesh(target.path(), document, added);

  CHECK(target.bytes().substr(0, source.bytes().size()) == source.bytes());
  const MeshDocument extended = read_mesh(target.path());
  check_same(extended, read_with_vtk(target.path()));
  const bool point_name_taken = find_array(document.point_arrays, "shape") != nullptr;
  const bool cell_name_taken = find_array(document.cell_arrays, "shape") != nullptr || ending == "strings";
  CHECK(extended.point_arrays.size() == document.point_arrays.size() + 2);
  CHECK(extended.cell_arrays.size() == document.cell_arrays.size() + 1);
  const std::vector<std::pair<const DataArray*, const DataArray*>> pairs{
      {&added.point_arrays[0], find_array(extended.point_arrays, "displacement")},
      {&added.point_arrays[1], find_array(extended.point_arrays, point_name_taken ? "shape_1" : "shape")},
      {&added.cell_arrays[0], find_array(extended.cell_arrays, cell_name_taken ? "shape_1" : "shape")}};
  for (const auto& [written, read] : pairs) {
    REQUIRE(read != nullptr);
    CHECK(read->type == written->type);
    CHECK(std::equal(read->bytes.begin(), read->bytes.end(), written->bytes.begin(), written->bytes.end()));
  }
}

TEST_CASE("legacy VTK: arrays can be added again to a file that has added ones") {
  const TemporaryFile source(grid_file(false, false).bytes(), ".vtk");
  const TemporaryFile target;
  AddedArrays added;
  added.cell_arrays = {hard_values<double>("shape", 7, 1)};
  write_mesh(target.path(), read_mesh(source.path()), added);
  const TemporaryFile again;
  write_mesh(again.path(), read_mesh(target.path()), added);
  const MeshDocument document = read_mesh(again.path());
  REQUIRE(document.cell_arrays.size() == 2);
  CHECK(document.cell_arrays[1].name == "shape_1");
  check_same(document, read_with_vtk(again.path()));
}

TEST_CASE("legacy VTK: VTK reads back every bit of a document from another format") {
  const ScalarType point_type = GENERATE(ScalarType::float32, ScalarType::float64);
  const bool finite = GENERATE(true, false);
  CAPTURE(finite);
  MeshDocument document = document_from_scratch(point_type);
  if (!finite) {
    document.cell_arrays.push_back(
        make_data_array("not finite", 1,
                        std::vector<float>{1, std::numeric_limits<float>::quiet_NaN(),
                                           -std::numeric_limits<float>::infinity(), 0, 0, 0, 0, 2}));
  }
  const TemporaryFile target;
  write_mesh(target.path(), document);
  CHECK(trismooth::what_is_lost(document, trismooth::FileFormat::vtk).empty());
  CHECK((target.bytes().find("\nASCII\n") != std::string::npos) == finite);
  check_same(document, read_with_vtk(target.path()));

  const MeshDocument back = read_mesh(target.path());
  CHECK(back.point_type == point_type);
  CHECK(std::ranges::equal(std::as_bytes(std::span(back.points)), std::as_bytes(std::span(document.points))));
  CHECK(back.cells.offsets == document.cells.offsets);
  CHECK(back.cells.connectivity == document.cells.connectivity);
  CHECK(back.cells.types == document.cells.types);
  REQUIRE(back.cell_arrays.size() == document.cell_arrays.size());
  for (std::size_t i = 0; i < back.cell_arrays.size(); ++i) {
    CHECK(back.cell_arrays[i].name == document.cell_arrays[i].name);
    CHECK(back.cell_arrays[i].type == document.cell_arrays[i].type);
    CHECK(std::ranges::equal(back.cell_arrays[i].bytes, document.cell_arrays[i].bytes));
  }
}

TEST_CASE("legacy VTK: a document that has not the points and cells of its file is not written over it") {
  const bool binary = GENERATE(false, true);
  const TemporaryFile source(file_with_ending(binary, false, "cells"), ".vtk");
  const MeshDocument document = read_mesh(source.path());
  const TemporaryFile target;
  const auto message = [&](const MeshDocument& changed, const AddedArrays& added = {}) -> std::string {
    try {
      write_mesh(target.path(), changed, added);
    } catch (const trismooth::WriteError& error) {
      CHECK_FALSE(std::filesystem::exists(target.path()));
      return error.reason;
    }
    return "written";
  };
  for (const std::size_t points : {0, 8, 10}) {
    MeshDocument changed = document;
    changed.points.resize(3 * points);
    changed.points.shrink_to_fit();
    // Without some points, cells name points that are not there.
    const std::string expected =
        points < 9 ? " names vertex " : "has 9 points and 7 cells, the mesh to write has 10 and 7";
    CHECK(message(changed).find(expected) != std::string::npos);
  }
  MeshDocument changed = document;
  changed.points.pop_back();
  CHECK(message(changed) != "written");
  changed = document;
  changed.cells.append(trismooth::cell_type::line, std::vector<std::int32_t>{0, 1});
  changed.cell_arrays.clear();
  CHECK(message(changed).find("7 cells") != std::string::npos);
  CHECK(message(document, {.point_arrays = {hard_values<double>("p", 8, 1)}, .cell_arrays = {}})
            .find("the array 'p' has 8 rows, the mesh to write has 9 points") != std::string::npos);
  CHECK(message(document, {.point_arrays = {}, .cell_arrays = {hard_values<double>("c", 9, 1)}})
            .find("the array 'c' has 9 rows, the mesh to write has 7 cells") != std::string::npos);
  CHECK(message(document) == "written");
}

TEST_CASE("legacy VTK: arrays of the same name or without one are all kept") {
  MeshDocument document = document_from_scratch(ScalarType::float64);
  document.point_arrays = {hard_values<float>("a", 20, 1), hard_values<float>("a", 20, 1),
                           hard_values<float>("", 20, 1)};
  const TemporaryFile target;
  write_mesh(target.path(), document);
  const MeshDocument back = read_mesh(target.path());
  REQUIRE(back.point_arrays.size() == 3);
  CHECK(back.point_arrays[0].name == "a");
  CHECK(back.point_arrays[1].name == "a_1");
  CHECK(back.point_arrays[2].name == "unnamed");
  check_same(back, read_with_vtk(target.path()));
}

TEST_CASE("legacy VTK: names survive their encoding") {
  for (int byte = 1; byte < 256; ++byte) {
    const std::string name = std::string("a") + static_cast<char>(byte) + "7";
    const std::string encoded = trismooth::encode_vtk_name(name);
    CHECK(trismooth::decode_vtk_name(encoded) == name);
    CHECK(std::all_of(encoded.begin(), encoded.end(), [](char c) { return c > ' ' && c <= '~'; }));
  }
  CHECK(trismooth::encode_vtk_name("heat flux") == "heat%20flux");
  CHECK(trismooth::decode_vtk_name("50%") == "50%");
  CHECK(trismooth::decode_vtk_name("50%2") == "50%2");
  CHECK(trismooth::decode_vtk_name("%zz%-1") == "%zz%-1");
}
