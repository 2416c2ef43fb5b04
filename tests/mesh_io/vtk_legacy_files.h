// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>
#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataReader.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>

#include "trismooth/mesh_io/mesh_file.h"

#include "catch.h"

namespace legacy_test {

/// A path of its own in the folder for temporary files; the file is removed in the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& extension = ".vtk") {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("trismooth_legacy_" + std::to_string(::getpid()) + "_" + std::to_string(count++) + extension);
  }
  TemporaryFile(const std::string& bytes, const std::string& extension) : TemporaryFile(extension) { write(bytes); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string bytes() const {
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  std::filesystem::path path_;
};

/// Puts legacy VTK files together, in ASCII or in BINARY from the same calls.
class Builder {
 public:
  Builder(bool binary, const std::string& version, const std::string& dataset) : binary_(binary) {
    text("# vtk DataFile Version " + version + "\na title\n" + (binary ? "BINARY" : "ASCII") + "\nDATASET " + dataset +
         "\n");
  }

  Builder& text(const std::string& text) {
    bytes_ += text;
    return *this;
  }

  template <class T>
  Builder& numbers(const std::vector<T>& values) {
    if (binary_) {
      for (const T value : values) {
        std::string stored(reinterpret_cast<const char*>(&value), sizeof(T));
        std::reverse(stored.begin(), stored.end());  // the tests run on little-endian machines
        bytes_ += stored;
      }
    } else {
      std::ostringstream stream;
      stream.precision(std::numeric_limits<T>::max_digits10);
      for (const T value : values) {
        stream << +value << ' ';
      }
      bytes_ += stream.str();
    }
    bytes_ += '\n';
    return *this;
  }

  /// A section of cells: of the old form, or of that of version 5.
  Builder& cells(const std::string& keyword, const std::vector<std::vector<int>>& cells, bool with_offsets) {
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int64_t> connectivity;
    std::vector<std::int32_t> counted;
    for (const std::vector<int>& cell : cells) {
      connectivity.insert(connectivity.end(), cell.begin(), cell.end());
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      counted.push_back(static_cast<std::int32_t>(cell.size()));
      counted.insert(counted.end(), cell.begin(), cell.end());
    }
    if (with_offsets) {
      text(keyword + " " + std::to_string(offsets.size()) + " " + std::to_string(connectivity.size()) + "\n");
      text("OFFSETS vtktypeint64\n").numbers(offsets);
      return text("CONNECTIVITY vtktypeint64\n").numbers(connectivity);
    }
    return text(keyword + " " + std::to_string(cells.size()) + " " + std::to_string(counted.size()) + "\n")
        .numbers(counted);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  bool binary_;
  std::string bytes_;
};

/// Nine points of a grid, a line, four triangles, a quad and a pentagon.
inline const std::vector<double>& grid_points() {
  static const std::vector<double> points{0, 0, 0,   1, 0.1,  0, 2, 0, 0, 0, 1, 0, 0.9, 1.0 / 3,
                                          0, 2, 1.5, 0, 1e-3, 2, 0, 1, 2, 0, 2, 2, 0};
  return points;
}
inline const std::vector<std::vector<int>>& grid_cells() {
  static const std::vector<std::vector<int>> cells{{0, 1},    {0, 1, 4},    {0, 4, 3},      {1, 2, 5},
                                                   {1, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7, 4}};
  return cells;
}
inline const std::vector<int>& grid_types() {
  static const std::vector<int> types{3, 5, 5, 5, 5, 9, 7};
  return types;
}

template <class T>
std::vector<T> grid_points_as() {
  return {grid_points().begin(), grid_points().end()};
}

/// The grid as an UNSTRUCTURED_GRID.
inline Builder grid_file(bool binary, bool with_offsets, bool with_float = false) {
  Builder builder(binary, with_offsets ? "5.1" : "3.0", "UNSTRUCTURED_GRID");
  if (with_float) {
    builder.text("POINTS 9 float\n").numbers(grid_points_as<float>());
  } else {
    builder.text("POINTS 9 double\n").numbers(grid_points());
  }
  builder.cells("CELLS", grid_cells(), with_offsets);
  builder.text("CELL_TYPES 7\n").numbers(grid_types());
  return builder;
}

template <class T>
std::vector<T> count_up(std::size_t count, double from, double step) {
  std::vector<T> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<T>(from + step * static_cast<double>(i)));
  }
  return values;
}

/// Every kind of attribute that the format has, `n` rows each.
inline void add_attributes(Builder& file, std::size_t n, bool binary, const std::string& prefix) {
  const std::string rows = std::to_string(n);
  file.text("SCALARS " + prefix + "scalars%20of%20float float\nLOOKUP_TABLE default\n")
      .numbers(count_up<float>(n, 0.1, 0.3));
  file.text("SCALARS " + prefix + "pairs short 2\nLOOKUP_TABLE table\n").numbers(count_up<std::int16_t>(2 * n, -3, 1));
  file.text("LOOKUP_TABLE table 2\n");
  if (binary) {
    file.numbers(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 10, 13});
  } else {
    file.text("1 0 0 1\n0 0 0.5 1\n");
  }
  file.text("COLOR_SCALARS " + prefix + "colours 3\n");
  if (binary) {
    file.numbers(count_up<std::uint8_t>(3 * n, 5, 4));
  } else {
    file.numbers(count_up<float>(3 * n, 0, 0.02));
  }
  file.text("vectors " + prefix + "velocity double\n").numbers(count_up<double>(3 * n, -1, 1.0 / 7));
  file.text("Normals " + prefix + "normal float\n").numbers(count_up<float>(3 * n, -1, 0.25));
  file.text("TEXTURE_COORDINATES " + prefix + "uv 2 float\n").numbers(count_up<float>(2 * n, 0, 0.125));
  file.text("TENSORS " + prefix + "stress double\n").numbers(count_up<double>(9 * n, 1e-300, 1e-301));
  file.text("TENSORS6 " + prefix + "strain float\n").numbers(count_up<float>(6 * n, 3, 0.1));
  file.text("GLOBAL_IDS " + prefix + "gid vtkIdType\n").numbers(count_up<std::int32_t>(n, 100, 3));
  file.text("PEDIGREE_IDS " + prefix + "pid int\n").numbers(count_up<std::int32_t>(n, -5, 2));
  file.text("FIELD FieldData 12\n");
  file.text(prefix + "bits 1 " + rows + " bit\n");
  if (binary) {
    file.numbers(std::vector<std::uint8_t>((n + 7) / 8, 0xb5));
  } else {
    file.numbers(std::vector<int>(n, 1));
  }
  file.text("NULL_ARRAY\n");
  file.text(prefix + "c 1 " + rows + " char\n").numbers(count_up<std::int8_t>(n, -4, 1));
  file.text(prefix + "uc 1 " + rows + " unsigned_char\n").numbers(count_up<std::uint8_t>(n, 250 - 9.0, 1));
  file.text(prefix + "us 2 " + rows + " unsigned_short\n").numbers(count_up<std::uint16_t>(2 * n, 65000, 1));
  file.text(prefix + "ui 1 " + rows + " unsigned_int\n").numbers(count_up<std::uint32_t>(n, 4294967000.0, 1));
  file.text(prefix + "l 1 " + rows + " long\n").numbers(count_up<std::int64_t>(n, -9e18, 1e6));
  file.text(prefix + "ul 1 " + rows + " unsigned_long\n").numbers(count_up<std::uint64_t>(n, 1.8e19, 1e6));
  file.text(prefix + "i64 1 " + rows + " vtktypeint64\n").numbers(count_up<std::int64_t>(n, -9e18, 1e6));
  file.text(
      "METADATA\nCOMPONENT_NAMES\nSCALARS%20of\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\n"
      "DATA 2 0 1 \n\n");
  file.text(prefix + "u64 1 " + rows + " vtktypeuint64\n").numbers(count_up<std::uint64_t>(n, 1.8e19, 1e6));
  file.text(prefix + "words 1 " + rows + " string\n");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string word(i, 'x');
    file.text(binary ? std::string(1, static_cast<char>(0xc0 | i)) + word : word + "\n");
  }
  file.text("\n" + prefix + "last 3 " + rows + " double\n").numbers(count_up<double>(3 * n, 0.7, 1e-9));
}

/// A POLYDATA whose sections stand in another order than VTK's.
inline Builder poly_data_file(bool binary, bool with_offsets) {
  Builder file(binary, with_offsets ? "5.1" : "2.0", "POLYDATA");
  file.text("POINTS 9 float\n").numbers(grid_points_as<float>());
  file.cells("TRIANGLE_STRIPS", {{3, 4, 6, 7}}, with_offsets);
  file.cells("POLYGONS", {{0, 1, 4}, {1, 2, 5, 4}, {4, 5, 8, 7, 3}}, with_offsets);
  file.cells("LINES", {{0, 1}, {0, 3, 6}}, with_offsets);
  file.cells("VERTICES", {{8}, {2, 5}}, with_offsets);
  return file;
}

/// What VTK's own reader makes of the file, every array of every kind.
inline vtkSmartPointer<vtkPointSet> read_with_vtk(const std::filesystem::path& path) {
  const auto read = [&](auto* reader) -> vtkSmartPointer<vtkPointSet> {
    reader->SetFileName(path.c_str());
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllNormalsOn();
    reader->ReadAllTensorsOn();
    reader->ReadAllColorScalarsOn();
    reader->ReadAllTCoordsOn();
    reader->ReadAllFieldsOn();
    reader->Update();
    return reader->GetOutput();
  };
  vtkNew<vtkDataReader> probe;
  probe->SetFileName(path.c_str());
  if (probe->IsFileValid("polydata") != 0) {
    return read(vtkNew<vtkPolyDataReader>().Get());
  }
  return read(vtkNew<vtkUnstructuredGridReader>().Get());
}

/// Same name, shape and numbers; the same bits where both sides have the same width.
inline void check_same(const trismooth::DataArray& ours, vtkAbstractArray* abstract) {
  CAPTURE(ours.name);
  REQUIRE(abstract != nullptr);
  auto* const theirs = vtkDataArray::SafeDownCast(abstract);
  REQUIRE(theirs != nullptr);
  REQUIRE(ours.components == static_cast<std::size_t>(theirs->GetNumberOfComponents()));
  REQUIRE(ours.rows() == static_cast<std::size_t>(theirs->GetNumberOfTuples()));
  if (static_cast<std::size_t>(theirs->GetDataTypeSize()) == trismooth::size_of(ours.type)) {
    const auto* const bytes = static_cast<const std::byte*>(theirs->GetVoidPointer(0));
    CHECK(std::equal(ours.bytes.begin(), ours.bytes.end(), bytes));
  } else {
    for (std::size_t row = 0; row < ours.rows(); ++row) {
      for (std::size_t c = 0; c < ours.components; ++c) {
        CHECK(ours.value(row, c) == theirs->GetComponent(static_cast<vtkIdType>(row), static_cast<int>(c)));
      }
    }
  }
}

inline void check_same(const std::vector<trismooth::DataArray>& ours, vtkFieldData* theirs) {
  int numeric = 0;
  for (int i = 0; i < theirs->GetNumberOfArrays(); ++i) {
    numeric += vtkDataArray::SafeDownCast(theirs->GetAbstractArray(i)) != nullptr ? 1 : 0;
  }
  CHECK(static_cast<int>(ours.size()) == numeric);
  for (const trismooth::DataArray& array : ours) {
    check_same(array, theirs->GetAbstractArray(array.name.c_str()));
  }
}

/// Points, cells and arrays agree with what VTK has.
inline void check_same(const trismooth::MeshDocument& ours, vtkPointSet* theirs) {
  REQUIRE(ours.point_count() == static_cast<std::size_t>(theirs->GetNumberOfPoints()));
  for (std::size_t point = 0; point < ours.point_count(); ++point) {
    std::array<double, 3> xyz{};
    theirs->GetPoint(static_cast<vtkIdType>(point), xyz.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(std::bit_cast<std::uint64_t>(ours.points[3 * point + axis]) == std::bit_cast<std::uint64_t>(xyz[axis]));
    }
  }
  REQUIRE(ours.cells.size() == static_cast<std::size_t>(theirs->GetNumberOfCells()));
  REQUIRE(ours.cells.offsets.size() == ours.cells.size() + 1);
  vtkNew<vtkIdList> ids;
  for (std::size_t cell = 0; cell < ours.cells.size(); ++cell) {
    CAPTURE(cell);
    CHECK(static_cast<int>(ours.cells.types[cell]) == theirs->GetCellType(static_cast<vtkIdType>(cell)));
    theirs->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    CHECK(std::vector<std::int64_t>(ours.cells[cell].begin(), ours.cells[cell].end()) ==
          std::vector<std::int64_t>(ids->begin(), ids->end()));
  }
  check_same(ours.point_arrays, theirs->GetPointData());
  check_same(ours.cell_arrays, theirs->GetCellData());
  check_same(ours.field_arrays, theirs->GetFieldData());
}

}  // namespace legacy_test
