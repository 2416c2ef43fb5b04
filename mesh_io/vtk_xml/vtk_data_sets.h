// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkAbstractArray.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace trismooth {

// Data sets for any number of arrays. In one of VTK's own, every array that is added makes it look at the names of all
// others (for ghost points), and its XML writer asks them all for their time of change before it writes the next one.

/// An empty vtkUnstructuredGrid.
vtkSmartPointer<vtkUnstructuredGrid> make_unstructured_grid();

/// An empty vtkPolyData.
vtkSmartPointer<vtkPolyData> make_poly_data();

/// Puts the array in the place of the point array of that number, whatever their names. The data set is one of those
/// made here.
void replace_point_array(vtkPointSet& data, int index, vtkAbstractArray& array);

/// One of the same kind with the same content; the arrays are shared. `data` is a vtkUnstructuredGrid or a vtkPolyData.
vtkSmartPointer<vtkPointSet> shallow_copy(vtkPointSet& data);

}  // namespace trismooth
