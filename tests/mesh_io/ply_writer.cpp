// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include "trismooth/mesh_io/mesh_file.h"

#include "byte_files.h"
#include "catch.h"

namespace trismooth::ply_writer_test {

using namespace byte_files;

template <class T>
DataArray random_array(std::mt19937_64& random, const std::string& name, std::size_t components, std::size_t rows) {
  std::vector<T> numbers(rows * components);
  for (T& number : numbers) {
    number = static_cast<T>(static_cast<std::int64_t>(random() % 2000001) - 1000000);
  }
  return trismooth::make_data_array(name, components, std::move(numbers));
}

/// Faces of 3 to 300 vertices, then lines; points and arrays of every PLY type.
MeshDocument random_document(unsigned seed, ScalarType point_type) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> anywhere(-1e6, 1e6);
  MeshDocument document;
  document.point_type = point_type;
  const std::size_t points = 3 + random() % 50;
  for (std::size_t i = 0; i < 3 * points; ++i) {
    const double x = anywhere(random);
    document.points.push_back(point_type == ScalarType::float32 ? static_cast<double>(static_cast<float>(x)) : x);
  }
  const auto append = [&](std::uint8_t type, std::size_t size) {
    std::vector<std::int32_t> cell(size);
    for (std::int32_t& vertex : cell) {
      vertex = static_cast<std::int32_t>(random() % points);
    }
    document.cells.append(type, cell);
  };
  for (std::size_t i = random() % 20; i > 0; --i) {
    append(cell_type::triangle, 3);
    append(cell_type::quad, 4);
  }
  append(cell_type::polygon, seed % 2 == 0 ? 300 : 5);
  for (std::size_t i = random() % 5; i > 0; --i) {
    append(cell_type::line, 2);
  }
  const std::size_t cells = document.cells.size();
  document.point_arrays = {
      random_array<std::int8_t>(random, "a", 1, points), random_array<std::uint8_t>(random, "b", 1, points),
      random_array<std::int16_t>(random, "c", 1, points), random_array<float>(random, "d", 1, points)};
  document.cell_arrays = {random_array<std::uint16_t>(random, "gmsh:physical", 1, cells),
                          random_array<std::int32_t>(random, "region", 1, cells),
                          random_array<std::uint32_t>(random, "f", 1, cells),
                          random_array<double>(random, "g", 1, cells)};
  return document;
}

void check_same_arrays(const std::vector<DataArray>& a, const std::vector<DataArray>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].name == b[i].name);
    CHECK(a[i].type == b[i].type);
    CHECK(std::ranges::equal(a[i].bytes, b[i].bytes));
  }
}

TEST_CASE("PLY: what is written from scratch is read back the same") {
  const auto type = GENERATE(ScalarType::float32, ScalarType::float64);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const MeshDocument document = random_document(seed, type);
    CHECK(trismooth::what_is_lost(document, trismooth::FileFormat::ply).empty());
    const TemporaryPath file(".ply");
    trismooth::write_mesh(file.path(), document);
    const MeshDocument back = trismooth::read_mesh(file.path());
    CHECK(back.points == document.points);
    CHECK(back.point_type == type);
    CHECK(back.cells.connectivity == document.cells.connectivity);
    CHECK(back.cells.offsets == document.cells.offsets);
    CHECK(back.cells.types == document.cells.types);
    check_same_arrays(back.point_arrays, document.point_arrays);
    check_same_arrays(back.cell_arrays, document.cell_arrays);
    CHECK(back.notes.empty());
    CHECK(written_back(back) == file.bytes());
  }
}

TEST_CASE("PLY: VTK reads what is written") {
  const auto type = GENERATE(ScalarType::float32, ScalarType::float64);
  MeshDocument document = random_document(7, type);
  const TemporaryPath file(".ply");
  trismooth::write_mesh(file.path(), document);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.path().c_str());
  reader->Update();
  vtkPolyData* const read = reader->GetOutput();
  REQUIRE(static_cast<std::size_t>(read->GetNumberOfPoints()) == document.point_count());
  for (std::size_t v = 0; v < document.point_count(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // VTK's reader holds float32.
      CHECK(read->GetPoint(static_cast<vtkIdType>(v))[axis] ==
            static_cast<double>(static_cast<float>(document.points[3 * v + axis])));
    }
  }
  const auto faces = static_cast<std::size_t>(
      std::ranges::count_if(document.cells.types, [](std::uint8_t cell) { return cell != cell_type::line; }));
  REQUIRE(static_cast<std::size_t>(read->GetPolys()->GetNumberOfCells()) == faces);
  vtkNew<vtkIdList> ids;
  for (std::size_t c = 0; c < faces; ++c) {
    read->GetPolys()->GetCellAtId(static_cast<vtkIdType>(c), ids);
    const auto cell = document.cells[c];
    REQUIRE(static_cast<std::size_t>(ids->GetNumberOfIds()) == cell.size());
    CHECK(std::equal(cell.begin(), cell.end(), ids->begin()));
  }
}

TEST_CASE("PLY: what cannot be kept is named, and all else is written") {
  MeshDocument document = random_document(3, ScalarType::float64);
  document.cells = {};
  document.cells.append(cell_type::line, std::vector<std::int32_t>{0, 1});
  document.cells.append(cell_type::vertex, std::vector<std::int32_t>{2});
  document.cells.append(cell_type::triangle, std::vector<std::int32_t>{0, 1, 2});
  document.cells.append(cell_type::poly_line, std::vector<std::int32_t>{0, 1, 2});
  using trismooth::make_data_array;
  document.point_arrays = {make_data_array("my velocity", 2, std::vector<double>(2 * document.point_count(), 0.5)),
                           make_data_array("x", 1, std::vector<float>(document.point_count(), 2))};
  document.cell_arrays = {make_data_array("region", 1, std::vector<std::int64_t>{-1, -2, -3, -4}),
                          make_data_array("id", 1, std::vector<std::uint64_t>{0, 0, 4294967295U, 0}),
                          make_data_array("hash", 1, std::vector<std::int64_t>{0, 0, -1, 4294967296})};
  document.field_arrays = {make_data_array("time", 1, std::vector<double>{1})};

  const std::vector<std::string> lost = trismooth::what_is_lost(document, trismooth::FileFormat::ply);
  const auto is_named = [&](const std::string& part) {
    return std::ranges::any_of(lost, [&](const std::string& sentence) { return contains(sentence, part); });
  };
  CHECK(lost.size() == 8);
  CHECK(is_named("1 vertex cell, 1 poly-line"));
  CHECK(is_named("another order"));
  CHECK(is_named("'my_velocity_0' to 'my_velocity_1'"));
  CHECK(is_named("'x' is written as 'x_1'"));
  CHECK(is_named("'region' is written as int32"));
  CHECK(is_named("'id' is written as uint32"));
  CHECK(is_named("'hash' is not written"));
  CHECK(is_named("field array 'time' is not written"));

  const TemporaryPath file(".ply");
  trismooth::write_mesh(file.path(), document);
  const MeshDocument back = trismooth::read_mesh(file.path());
  CHECK(back.points == document.points);
  CHECK(back.cells.types == std::vector<std::uint8_t>{cell_type::triangle, cell_type::line});
  CHECK(values<double>(find_array(back.point_arrays, "my_velocity_1"))[1] == 0.5);
  CHECK(values<float>(find_array(back.point_arrays, "x_1"))[0] == 2);
  CHECK(values<std::int32_t>(find_array(back.cell_arrays, "region")) == std::vector<std::int32_t>{-3, -1});
  CHECK(values<std::uint32_t>(find_array(back.cell_arrays, "id")) == std::vector<std::uint32_t>{4294967295U, 0});
  CHECK(find_array(back.cell_arrays, "hash") == nullptr);
}

}  // namespace trismooth::ply_writer_test
