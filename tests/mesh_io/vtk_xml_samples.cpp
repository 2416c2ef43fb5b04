// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_xml_samples.h"

#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <unistd.h>
#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "support/sanitized.h"

namespace vtk_xml_samples {

using trismooth::ScalarType;
using trismooth::VtkXmlCompressor;
using trismooth::VtkXmlEncoding;
using trismooth::VtkXmlKind;
using trismooth::VtkXmlMode;

namespace {

vtkSmartPointer<vtkDataArray> make_array(int type, const std::string& name, int components, vtkIdType rows) {
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(rows);
  for (vtkIdType row = 0; row < rows; ++row) {
    for (int i = 0; i < components; ++i) {
      array->SetComponent(row, i, static_cast<double>((row * 7 + i * 3) % 120));
    }
  }
  return array;
}

double with_payload(std::uint64_t bits) {
  double value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

void add_arrays(vtkDataSetAttributes& attributes, vtkIdType rows, SpecialValues special) {
  const std::pair<int, const char*> types[] = {
      {VTK_SIGNED_CHAR, "int8"}, {VTK_UNSIGNED_CHAR, "uint8"}, {VTK_SHORT, "int16"}, {VTK_UNSIGNED_SHORT, "uint16"},
      {VTK_INT, "int32"},        {VTK_UNSIGNED_INT, "uint32"}, {VTK_LONG, "int64"},  {VTK_UNSIGNED_LONG, "uint64"},
      {VTK_FLOAT, "float32"},    {VTK_DOUBLE, "float64"},      {VTK_ID_TYPE, "ids"}};
  for (const auto& [type, name] : types) {
    attributes.AddArray(make_array(type, name, 1, rows));
  }
  vtkDataArray& int64 = *attributes.GetArray("int64");
  int64.SetVariantValue(0, vtkVariant(std::numeric_limits<long>::min()));
  int64.SetVariantValue(1, vtkVariant((1L << 53) + 1));
  attributes.GetArray("uint64")->SetVariantValue(0, vtkVariant(std::numeric_limits<unsigned long>::max()));
  attributes.GetArray("int8")->SetComponent(0, 0, -128);

  const auto reals = make_array(VTK_DOUBLE, "vectors", 3, rows);
  const double plain[] = {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.5, 1e22};
  for (vtkIdType i = 0; i < 6; ++i) {
    reals->SetComponent(i / 3, static_cast<int>(i % 3), plain[i]);
  }
  const auto floats = make_array(VTK_FLOAT, "plane floats", 2, rows);
  floats->SetComponent(0, 0, 0.1F);
  floats->SetComponent(0, 1, 1e-45F);
  floats->SetComponentName(0, "radial");
  floats->SetComponentName(1, "axial");
  if (special == SpecialValues::all) {
    auto* const real = vtkDoubleArray::SafeDownCast(reals)->GetPointer(0);
    real[6] = -0.0;
    real[7] = with_payload(0x7FF8000000001234);
    real[8] = with_payload(0xFFF800000000ABCD);
    real[9] = -std::numeric_limits<double>::infinity();
    auto* const value = vtkFloatArray::SafeDownCast(floats)->GetPointer(0);
    value[2] = std::nanf("0x77");
    value[3] = std::numeric_limits<float>::infinity();
    value[4] = -0.0F;
  }
  floats->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "m/s");
  attributes.AddArray(reals);
  attributes.AddArray(floats);
  attributes.AddArray(make_array(VTK_UNSIGNED_CHAR, "vtkGhostType", 1, rows));
  attributes.AddArray(make_array(VTK_INT, "nine", 9, rows));

  const vtkNew<vtkStringArray> strings;
  strings->SetName("strings");
  for (vtkIdType i = 0; i < rows; ++i) {
    strings->InsertNextValue(i == 1 ? "" : "stahl \xC3\xA4 <" + std::to_string(i) + ">");
  }
  attributes.AddArray(strings);
  const vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (vtkIdType i = 0; i < rows; ++i) {
    bits->InsertNextValue(i % 3 == 0 ? 1 : 0);
  }
  attributes.AddArray(bits);
  attributes.SetActiveAttribute("float64", vtkDataSetAttributes::SCALARS);
  attributes.SetActiveAttribute("vectors", vtkDataSetAttributes::VECTORS);
  attributes.SetActiveAttribute("ids", vtkDataSetAttributes::GLOBALIDS);
}

vtkSmartPointer<vtkPoints> make_points(ScalarType type, int n) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type == ScalarType::float64 ? VTK_DOUBLE : VTK_FLOAT);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      points->InsertNextPoint(x + 0.1 * ((x * y) % 3), y + 1.0 / (3 + x), 0.25);
    }
  }
  return points;
}

using Cell = std::vector<vtkIdType>;

vtkSmartPointer<vtkCellArray> make_cells(const std::vector<Cell>& cells, bool wide) {
  auto array = vtkSmartPointer<vtkCellArray>::New();
  if (!wide) {
    array->Use32BitStorage();
  }
  for (const Cell& cell : cells) {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

vtkSmartPointer<vtkPointSet> make_data_set(VtkXmlKind kind, const std::vector<std::pair<int, Cell>>& cells, bool wide) {
  if (kind == VtkXmlKind::unstructured_grid) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    const vtkNew<vtkUnsignedCharArray> types;
    std::vector<Cell> all;
    for (const auto& [type, cell] : cells) {
      types->InsertNextValue(static_cast<unsigned char>(type));
      all.push_back(cell);
    }
    grid->SetCells(types, make_cells(all, wide));
    return grid;
  }
  std::vector<Cell> verts;
  std::vector<Cell> lines;
  std::vector<Cell> polys;
  std::vector<Cell> strips;
  for (const auto& [type, cell] : cells) {
    (type == VTK_VERTEX || type == VTK_POLY_VERTEX ? verts
     : type == VTK_LINE || type == VTK_POLY_LINE   ? lines
     : type == VTK_TRIANGLE_STRIP                  ? strips
                                                   : polys)
        .push_back(cell);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetVerts(make_cells(verts, wide));
  data->SetLines(make_cells(lines, wide));
  data->SetPolys(make_cells(polys, wide));
  data->SetStrips(make_cells(strips, wide));
  return data;
}

/// VTK's reader makes "long long" of what was "long": the same in the file.
int file_type_of(vtkAbstractArray& array) {
  const int type = array.GetDataType();
  return type == VTK_LONG_LONG ? VTK_LONG : type == VTK_UNSIGNED_LONG_LONG ? VTK_UNSIGNED_LONG : type;
}

std::string array_differences(vtkAbstractArray* a, vtkAbstractArray* b, const std::string& where) {
  if (a == nullptr || b == nullptr) {
    return a == b ? "" : where + ": missing\n";
  }
  std::ostringstream text;
  const std::string name = a->GetName() == nullptr ? "" : a->GetName();
  const std::string other_name = b->GetName() == nullptr ? "" : b->GetName();
  if (name != other_name) {
    text << where << ": name " << name << ", " << other_name << '\n';
  }
  if (file_type_of(*a) != file_type_of(*b) || a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
      a->GetNumberOfTuples() != b->GetNumberOfTuples()) {
    text << where << ' ' << name << ": " << a->GetDataTypeAsString() << ' ' << a->GetNumberOfComponents() << " x "
         << a->GetNumberOfTuples() << ", " << b->GetDataTypeAsString() << ' ' << b->GetNumberOfComponents() << " x "
         << b->GetNumberOfTuples() << '\n';
    return text.str();
  }
  for (int i = 0; i < a->GetNumberOfComponents(); ++i) {
    const char* const label = a->GetComponentName(i);
    const char* const other = b->GetComponentName(i);
    if (std::string(label == nullptr ? "" : label) != (other == nullptr ? "" : other)) {
      text << where << ' ' << name << ": name of component " << i << '\n';
    }
  }
  const auto count = static_cast<std::size_t>(a->GetNumberOfValues());
  bool same = true;
  if (a->GetDataType() == VTK_STRING || a->GetDataType() == VTK_BIT) {
    for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i) {
      same = same && a->GetVariantValue(i) == b->GetVariantValue(i);
    }
  } else if (count > 0) {
    same = std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
                       count * static_cast<std::size_t>(a->GetDataTypeSize())) == 0;
  }
  if (!same) {
    text << where << ' ' << name << ": values\n";
  }
  const bool units = a->GetInformation()->Has(vtkDataArray::UNITS_LABEL()) != 0;
  if (units != (b->GetInformation()->Has(vtkDataArray::UNITS_LABEL()) != 0) ||
      (units && std::string(a->GetInformation()->Get(vtkDataArray::UNITS_LABEL())) !=
                    b->GetInformation()->Get(vtkDataArray::UNITS_LABEL()))) {
    text << where << ' ' << name << ": units\n";
  }
  return text.str();
}

std::string field_differences(vtkFieldData& a, vtkFieldData& b, const std::string& where) {
  std::ostringstream text;
  if (a.GetNumberOfArrays() != b.GetNumberOfArrays()) {
    text << where << ": " << a.GetNumberOfArrays() << " arrays, " << b.GetNumberOfArrays() << " arrays\n";
  }
  for (int i = 0; i < std::min(a.GetNumberOfArrays(), b.GetNumberOfArrays()); ++i) {
    text << array_differences(a.GetAbstractArray(i), b.GetAbstractArray(i), where);
  }
  auto* const attributes = vtkDataSetAttributes::SafeDownCast(&a);
  auto* const others = vtkDataSetAttributes::SafeDownCast(&b);
  for (int i = 0; attributes != nullptr && i < vtkDataSetAttributes::NUM_ATTRIBUTES; ++i) {
    vtkAbstractArray* const active = attributes->GetAbstractAttribute(i);
    vtkAbstractArray* const other = others->GetAbstractAttribute(i);
    if ((active == nullptr) != (other == nullptr) ||
        (active != nullptr && std::string(active->GetName()) != other->GetName())) {
      text << where << ": active " << vtkDataSetAttributes::GetAttributeTypeAsString(i) << '\n';
    }
  }
  return text.str();
}

std::string cell_differences(vtkCellArray* a, vtkCellArray* b, const std::string& where) {
  if (a == nullptr || b == nullptr) {
    return a == b ? "" : where + ": missing\n";
  }
  if (a->GetNumberOfCells() == 0 && b->GetNumberOfCells() == 0) {
    return "";
  }
  // Cell arrays made in memory have no names.
  for (vtkCellArray* const cells : {a, b}) {
    cells->GetOffsetsArray()->SetName("offsets");
    cells->GetConnectivityArray()->SetName("connectivity");
  }
  return (a->IsStorage64Bit() == b->IsStorage64Bit() ? "" : where + ": width of indices\n") +
         array_differences(a->GetOffsetsArray(), b->GetOffsetsArray(), where + " offsets") +
         array_differences(a->GetConnectivityArray(), b->GetConnectivityArray(), where + " connectivity");
}

template <class Writer>
void write_as(vtkPointSet& data, const std::filesystem::path& path, const VtkXmlEncoding& encoding) {
  const vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetFileName(path.c_str());
  writer->SetDataMode(encoding.mode == VtkXmlMode::ascii    ? vtkXMLWriter::Ascii
                      : encoding.mode == VtkXmlMode::binary ? vtkXMLWriter::Binary
                                                            : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(encoding.appended_base64);
  writer->SetByteOrder(encoding.big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
  writer->SetHeaderType(encoding.wide_block_headers ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  writer->SetCompressorType(encoding.compressor == VtkXmlCompressor::zlib   ? vtkXMLWriter::ZLIB
                            : encoding.compressor == VtkXmlCompressor::lz4  ? vtkXMLWriter::LZ4
                            : encoding.compressor == VtkXmlCompressor::lzma ? vtkXMLWriter::LZMA
                                                                            : vtkXMLWriter::NONE);
  writer->SetBlockSize(128);
  writer->Write();
}

template <class Reader>
vtkSmartPointer<vtkPointSet> read_as(const std::filesystem::path& path) {
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

TemporaryPath::TemporaryPath(const std::string& extension) {
  static std::atomic<int> count{0};
  path_ = std::filesystem::temp_directory_path() /
          ("trismooth_vtk_xml_" + std::to_string(::getpid()) + "_" + std::to_string(count++) + extension);
}

TemporaryPath::~TemporaryPath() {
  std::error_code error;
  std::filesystem::remove(path_, error);
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

vtkSmartPointer<vtkPointSet> make_sample(VtkXmlKind kind, ScalarType point_type, SpecialValues special) {
  std::vector<std::pair<int, Cell>> cells{{VTK_TRIANGLE, {0, 1, 4}}, {VTK_LINE, {0, 1}},
                                          {VTK_QUAD, {1, 2, 6, 5}},  {VTK_VERTEX, {3}},
                                          {VTK_TRIANGLE, {4, 1, 5}}, {VTK_POLYGON, {8, 9, 10, 14, 13}},
                                          {VTK_TRIANGLE, {2, 7, 6}}, {VTK_POLY_LINE, {12, 13, 14}}};
  cells.emplace_back(VTK_TRIANGLE_STRIP, Cell{4, 5, 8, 9});
  if (kind == VtkXmlKind::unstructured_grid) {
    cells.emplace_back(VTK_QUADRATIC_TRIANGLE, Cell{0, 2, 8, 1, 5, 4});
    cells.emplace_back(VTK_PIXEL, Cell{10, 11, 14, 15});
  }
  const auto data = make_data_set(kind, cells, point_type == ScalarType::float64);
  data->SetPoints(make_points(point_type, 4));
  add_arrays(*data->GetPointData(), data->GetNumberOfPoints(), special);
  add_arrays(*data->GetCellData(), data->GetNumberOfCells(), special);
  data->GetCellData()->SetActiveAttribute("int32", vtkDataSetAttributes::SCALARS);
  data->GetFieldData()->AddArray(make_array(VTK_DOUBLE, "TimeValue", 1, 1));
  data->GetFieldData()->AddArray(make_array(VTK_INT, "table", 3, 5));
  data->GetFieldData()->AddArray(make_array(VTK_FLOAT, "empty", 2, 0));
  const vtkNew<vtkStringArray> strings;
  strings->SetName("history");
  strings->InsertNextValue("made by a test");
  data->GetFieldData()->AddArray(strings);
  return data;
}

vtkSmartPointer<vtkPointSet> make_grid(VtkXmlKind kind, int n) {
  std::vector<std::pair<int, Cell>> cells;
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const vtkIdType a = y * n + x;
      cells.emplace_back(VTK_TRIANGLE, Cell{a, a + 1, a + n + 1});
      cells.emplace_back(VTK_TRIANGLE, Cell{a, a + n + 1, a + n});
    }
  }
  auto data = make_data_set(kind, cells, true);
  data->SetPoints(make_points(ScalarType::float64, n));
  data->GetPointData()->AddArray(make_array(VTK_FLOAT, "height", 1, data->GetNumberOfPoints()));
  data->GetCellData()->AddArray(make_array(VTK_INT, "region", 1, data->GetNumberOfCells()));
  const vtkNew<vtkStringArray> strings;
  strings->SetName("names");
  strings->InsertNextValue("abc");
  strings->InsertNextValue("d");
  data->GetFieldData()->AddArray(strings);
  return data;
}

void write_with_vtk(vtkPointSet& data, const std::filesystem::path& path, const VtkXmlEncoding& encoding) {
  if (vtkUnstructuredGrid::SafeDownCast(&data) != nullptr) {
    write_as<vtkXMLUnstructuredGridWriter>(data, path, encoding);
  } else {
    write_as<vtkXMLPolyDataWriter>(data, path, encoding);
  }
}

vtkSmartPointer<vtkPointSet> read_with_vtk(const std::filesystem::path& path, VtkXmlKind kind) {
  return kind == VtkXmlKind::unstructured_grid ? read_as<vtkXMLUnstructuredGridReader>(path)
                                               : read_as<vtkXMLPolyDataReader>(path);
}

std::string differences(vtkPointSet& a, vtkPointSet& b) {
  std::string text = array_differences(a.GetPoints()->GetData(), b.GetPoints()->GetData(), "points");
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&a)) {
    auto* const other = vtkUnstructuredGrid::SafeDownCast(&b);
    text += cell_differences(grid->GetCells(), other->GetCells(), "cells");
    text += array_differences(grid->GetCellTypesArray(), other->GetCellTypesArray(), "types");
  } else {
    auto* const data = vtkPolyData::SafeDownCast(&a);
    auto* const other = vtkPolyData::SafeDownCast(&b);
    text += cell_differences(data->GetVerts(), other->GetVerts(), "verts");
    text += cell_differences(data->GetLines(), other->GetLines(), "lines");
    text += cell_differences(data->GetPolys(), other->GetPolys(), "polys");
    text += cell_differences(data->GetStrips(), other->GetStrips(), "strips");
  }
  return text + field_differences(*a.GetPointData(), *b.GetPointData(), "point data") +
         field_differences(*a.GetCellData(), *b.GetCellData(), "cell data") +
         field_differences(*a.GetFieldData(), *b.GetFieldData(), "field data");
}

std::vector<VtkXmlEncoding> all_encodings() {
  std::vector<VtkXmlEncoding> encodings;
  for (const auto& [mode, base64] : {std::pair(VtkXmlMode::ascii, true), std::pair(VtkXmlMode::binary, true),
                                     std::pair(VtkXmlMode::appended, true), std::pair(VtkXmlMode::appended, false)}) {
    for (const auto compressor :
         {VtkXmlCompressor::none, VtkXmlCompressor::zlib, VtkXmlCompressor::lz4, VtkXmlCompressor::lzma}) {
      for (const bool big_endian : {false, true}) {
        for (const bool wide : {false, true}) {
          if (is_sanitized && compressor == VtkXmlCompressor::lzma && (base64 || big_endian || wide)) {
            continue;
          }
          encodings.push_back({mode, base64, compressor, big_endian, wide});
        }
      }
    }
  }
  return encodings;
}

std::string to_string(const VtkXmlEncoding& encoding) {
  constexpr const char* modes[] = {"ascii", "binary", "appended"};
  constexpr const char* compressors[] = {"none", "zlib", "lz4", "lzma"};
  return std::string(modes[static_cast<int>(encoding.mode)]) + (encoding.appended_base64 ? " base64 " : " raw ") +
         compressors[static_cast<int>(encoding.compressor)] + (encoding.big_endian ? " big" : " little") +
         (encoding.wide_block_headers ? " 64" : " 32");
}

}  // namespace vtk_xml_samples
