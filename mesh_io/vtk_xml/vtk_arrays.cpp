// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_arrays.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkType.h>

#include "trismooth/mesh_io/vtk_xml/vtk_array_description.h"

namespace trismooth {

int vtk_type_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return VTK_TYPE_INT8;
    case ScalarType::uint8:
      return VTK_TYPE_UINT8;
    case ScalarType::int16:
      return VTK_TYPE_INT16;
    case ScalarType::uint16:
      return VTK_TYPE_UINT16;
    case ScalarType::int32:
      return VTK_TYPE_INT32;
    case ScalarType::uint32:
      return VTK_TYPE_UINT32;
    case ScalarType::int64:
      return VTK_TYPE_INT64;
    case ScalarType::uint64:
      return VTK_TYPE_UINT64;
    case ScalarType::float32:
      return VTK_TYPE_FLOAT32;
    case ScalarType::float64:
      break;
  }
  return VTK_TYPE_FLOAT64;
}

std::optional<ScalarType> scalar_type_of(vtkAbstractArray* array) {
  static_assert(sizeof(long) == 8 && sizeof(vtkIdType) == 8, "64-bit Linux");
  switch (array->GetDataType()) {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return ScalarType::int8;
    case VTK_UNSIGNED_CHAR:
      return ScalarType::uint8;
    case VTK_SHORT:
      return ScalarType::int16;
    case VTK_UNSIGNED_SHORT:
      return ScalarType::uint16;
    case VTK_INT:
      return ScalarType::int32;
    case VTK_UNSIGNED_INT:
      return ScalarType::uint32;
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return ScalarType::int64;
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return ScalarType::uint64;
    case VTK_FLOAT:
      return ScalarType::float32;
    case VTK_DOUBLE:
      return ScalarType::float64;
    default:
      return std::nullopt;
  }
}

vtkSmartPointer<vtkDataArray> make_vtk_array(ScalarType type, std::size_t components, MemoryBlock numbers, bool ids) {
  vtkSmartPointer<vtkDataArray> array;
  if (ids) {
    array = vtkSmartPointer<vtkIdTypeArray>::New();
  } else {
    array.TakeReference(vtkDataArray::CreateDataArray(vtk_type_of(type)));
  }
  array->SetNumberOfComponents(static_cast<int>(components));
  numbers.shrink_to_fit();
  const auto count = static_cast<vtkIdType>(numbers.size() / size_of(type));
  if (count > 0) {
    array->SetVoidArray(numbers.release(), count, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  }
  return array;
}

vtkSmartPointer<vtkDataArray> view_as_vtk_array(const DataArray& array) {
  std::vector<std::string> losses;  // said by what_is_lost()
  return view_as_vtk_array(array, losses);
}

vtkSmartPointer<vtkDataArray> view_as_vtk_array(const DataArray& array, std::vector<std::string>& losses) {
  vtkSmartPointer<vtkDataArray> view;
  view.TakeReference(vtkDataArray::CreateDataArray(has_id_role(array) ? VTK_ID_TYPE : vtk_type_of(array.type)));
  view->SetName(array.name.c_str());
  view->SetNumberOfComponents(static_cast<int>(array.components));
  if (!array.bytes.empty()) {
    // VTK knows no read-only arrays; nobody writes to this one.
    auto* const numbers = const_cast<std::byte*>(array.bytes.data());
    view->SetVoidArray(numbers, static_cast<vtkIdType>(array.bytes.size() / size_of(array.type)), 1);
  }
  describe(*view, array.description.get(), losses);
  return view;
}

std::optional<DataArray> view_as_data_array(vtkAbstractArray* array) {
  const std::optional<ScalarType> type = scalar_type_of(array);
  if (!type || !array->HasStandardMemoryLayout()) {
    return std::nullopt;
  }
  const vtkSmartPointer<vtkAbstractArray> owner = array;
  const auto count = static_cast<std::size_t>(array->GetNumberOfValues());
  const auto* const numbers = count == 0 ? nullptr : static_cast<const std::byte*>(array->GetVoidPointer(0));
  return DataArray{
      array->GetName() == nullptr ? "" : array->GetName(),           *type,
      static_cast<std::size_t>(array->GetNumberOfComponents()),      std::span(numbers, count * size_of(*type)),
      std::shared_ptr<const void>(numbers, [owner](const void*) {}), description_of(*array)};
}

bool holds_non_finite(const DataArray& array) {
  const auto any = [](auto values) {
    return std::ranges::any_of(values, [](auto value) { return !std::isfinite(value); });
  };
  return (array.type == ScalarType::float32 && any(array.as<float>())) ||
         (array.type == ScalarType::float64 && any(array.as<double>()));
}

void reserve_vtk_arrays(vtkFieldData& fields, std::size_t count) {
  fields.AllocateArrays(fields.GetNumberOfArrays() + static_cast<int>(count));
}

void add_vtk_array(vtkFieldData& fields, vtkAbstractArray& array, const std::string& name) {
  // Names are compared when the array is added; one that is set later is not looked at.
  array.SetName(nullptr);
  fields.AddArray(&array);
  array.SetName(name.c_str());
}

}  // namespace trismooth
