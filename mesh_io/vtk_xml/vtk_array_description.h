// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <vtkAbstractArray.h>
#include <vtkDataSetAttributes.h>

#include "trismooth/mesh_io/data_array.h"

namespace trismooth {

/// Names of components and information of a VTK array; null where it has none. Its roles are not the array's own to
/// tell: see add_roles().
std::shared_ptr<const ArrayDescription> description_of(vtkAbstractArray& array);

/// Gives the VTK array the names of components and the information of `description`, which may be null. What VTK cannot
/// take gives a sentence in `losses`.
void describe(vtkAbstractArray& array, const ArrayDescription* description, std::vector<std::string>& losses);

/// Says in `views`, views of arrays of `attributes` in their order, which of them are active, and as what.
void add_roles(vtkDataSetAttributes& attributes, std::span<DataArray> views);

/// Makes the arrays of `attributes` active that `arrays` say: array i of both is the same. A role that VTK does not
/// give to such an array, or that it has given already, gives a sentence in `losses`.
void set_roles(std::span<const DataArray> arrays, vtkDataSetAttributes& attributes, std::vector<std::string>& losses);

/// True where VTK wants an array of its own index type for one of the roles.
bool has_id_role(const DataArray& array);

}  // namespace trismooth
