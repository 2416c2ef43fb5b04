#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
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
    CHECK(std::memcmp(ours.bytes.data(), theirs->GetVoidPointer(0), ours.bytes.size()) == 0);
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
    double xyz[3];
    theirs->GetPoint(static_cast<vtkIdType>(point), xyz);
    CHECK(std::memcmp(&ours.points[3 * point], xyz, sizeof(xyz)) == 0);
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
