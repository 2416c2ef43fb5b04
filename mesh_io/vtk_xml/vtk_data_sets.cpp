#include "trismooth/mesh_io/vtk_xml/vtk_data_sets.h"

#include <vtkCellData.h>
#include <vtkPointData.h>

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
  vtkMTimeType GetMTime() override { return this->MTime.GetMTime(); }
};

/// vtkUnstructuredGrid or vtkPolyData that does not observe its point and cell data.
template <class DataSet>
class AnyNumberOfArrays final : public DataSet {
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

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> make_unstructured_grid() {
  return make<AnyNumberOfArrays<vtkUnstructuredGrid>>();
}

vtkSmartPointer<vtkPolyData> make_poly_data() {
  return make<AnyNumberOfArrays<vtkPolyData>>();
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
