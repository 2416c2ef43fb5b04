// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkSmartPointer.h>

#include "trismooth/mesh_io/bytes/memory_block.h"
#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// The VTK_... constant of the type.
int vtk_type_of(ScalarType type);

/// The type of number that a VTK array holds; nothing for bits, strings and the like.
std::optional<ScalarType> scalar_type_of(vtkAbstractArray* array);

/// An unnamed VTK array of that type that takes the numbers over (rows of `components` numbers). No copy.
/// `ids` makes it a vtkIdTypeArray, for int64 only.
vtkSmartPointer<vtkDataArray> make_vtk_array(ScalarType type, std::size_t components, MemoryBlock numbers,
                                             bool ids = false);

/// A VTK array of the same name and description that views the numbers of `array`, which must outlive it. No copy.
vtkSmartPointer<vtkDataArray> view_as_vtk_array(const DataArray& array);
/// view_as_vtk_array() that tells what VTK cannot take of the description: a sentence each in `losses`.
vtkSmartPointer<vtkDataArray> view_as_vtk_array(const DataArray& array, std::vector<std::string>& losses);

/// A view of a VTK array's numbers with its description, which keeps that array alive; nothing for an array that does
/// not hold numbers row by row in one piece of memory.
std::optional<DataArray> view_as_data_array(vtkAbstractArray* array);

/// True where the array holds a NaN or an infinity.
bool holds_non_finite(const DataArray& array);

/// Makes room for `count` arrays more. VTK does so for each array by itself, and copies the list of all the others.
void reserve_vtk_arrays(vtkFieldData& fields, std::size_t count);

/// Gives the array that name and adds it; one that is there under the same name already stays, too (VTK's own
/// AddArray() would replace it, and looks at the names of all others). The array must belong to nobody else yet.
void add_vtk_array(vtkFieldData& fields, vtkAbstractArray& array, const std::string& name);

}  // namespace trismooth
