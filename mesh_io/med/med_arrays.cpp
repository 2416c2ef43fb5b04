// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/med/med_arrays.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/document/array_components.h"
#include "trismooth/mesh_io/document/cells/group_lists.h"
#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

ScalarType med_field_type(const DataArray& array) {
  const ScalarType type = widened_type(array);
  return type == ScalarType::float32 ? ScalarType::float64 : type;
}

MedFieldPlan plan_med_fields(const MeshDocument& document, const GroupArrays& left_out) {
  MedFieldPlan plan;
  FreeNames taken;
  std::vector<std::string> names;
  for (const DataArray& array : document.point_arrays) {
    plan.fields.push_back({{}, &array, nullptr});
    names.push_back(taken.claim(array.name));
  }
  for (const DataArray& array : document.cell_arrays) {
    if (left_out.has(array.name)) {
      continue;
    }
    const auto same = std::ranges::find_if(plan.fields, [&array](const MedField& field) {
      return field.at_cells == nullptr && field.at_points->name == array.name &&
             field.at_points->components == array.components &&
             med_field_type(*field.at_points) == med_field_type(array);
    });
    if (same != plan.fields.end()) {
      same->at_cells = &array;
    } else {
      plan.fields.push_back({{}, nullptr, &array});
      names.push_back(taken.claim(array.name));
    }
  }
  FittedNames fitted = fit_names(names, med_field_name_size, "/");
  for (std::size_t i = 0; i < names.size(); ++i) {
    plan.fields[i].name = std::move(fitted.names[i]);
    if (names[i] != plan.fields[i].any().name) {
      plan.renamed.push_back(plan.fields[i].any().name + " (as " + plan.fields[i].name + ")");
    }
  }
  std::ranges::move(fitted.renamed, std::back_inserter(plan.renamed));
  return plan;
}

}  // namespace trismooth
