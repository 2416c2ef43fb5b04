// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_data_sets.h"

#include <array>
#include <cstddef>
#include <span>

#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

namespace trismooth {

namespace {

/// An object of a class that is made here, not by VTK's macros.
template <class Object>
vtkSmartPointer<Object> make() {
  auto* const object = new Object;
  object->InitializeObjectBase();
  return vtkSmartPointer<Object>::Take(object);
}

/// vtkPointData or vtkCellData without the times of its arrays.
template <class Attributes>
class OwnTimeOnly final : public Attributes {
 public:
  using Attributes::SetArray;
  vtkMTimeType GetMTime() override { return this->MTime.GetMTime(); }
};

/// vtkUnstructuredGrid or vtkPolyData that does not observe its point and cell data.
template <class DataSet>
class AnyNumberOfArrays : public DataSet {
 public:
  AnyNumberOfArrays() {
    replace(this->PointData);
    replace(this->CellData);
  }

 private:
  template <class Attributes>
  static void replace(Attributes*& attributes) {
    const auto own = make<OwnTimeOnly<Attributes>>();
    own->Register(nullptr);  // the data set deletes it
    attributes->Delete();
    attributes = own;
  }
};

/// A vtkUnstructuredGrid that finds the types of its cells, as the writer asks for them, in a hundredth of the time.
class Grid final : public AnyNumberOfArrays<vtkUnstructuredGrid> {
 public:
  void GetCellTypes(vtkCellTypes* types) override {
    types->Reset();
    vtkUnsignedCharArray* const array = this->GetCellTypesArray();
    if (array == nullptr) {
      return;
    }
    std::array<bool, 256> seen{};
    for (const unsigned char type :
         std::span(array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()))) {
      seen[type] = true;
    }
    for (std::size_t type = 0; type < seen.size(); ++type) {
      if (seen[type]) {
        types->InsertNextType(static_cast<unsigned char>(type));
      }
    }
  }
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> make_unstructured_grid() {
  return make<Grid>();
}

vtkSmartPointer<vtkPolyData> make_poly_data() {
  return make<AnyNumberOfArrays<vtkPolyData>>();
}

void replace_point_array(vtkPointSet& data, int index, vtkAbstractArray& array) {
  dynamic_cast<OwnTimeOnly<vtkPointData>&>(*data.GetPointData()).SetArray(index, &array);
}

vtkSmartPointer<vtkPointSet> shallow_copy(vtkPointSet& data) {
  vtkSmartPointer<vtkPointSet> copy;
  if (vtkUnstructuredGrid::SafeDownCast(&data) != nullptr) {
    copy = make_unstructured_grid();
  } else {
    copy = make_poly_data();
  }
  copy->ShallowCopy(&data);
  return copy;
}

}  // namespace trismooth
