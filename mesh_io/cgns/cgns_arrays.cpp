// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_arrays.h"

#include <utility>

#include "trismooth/mesh_io/document/cells/group_lists.h"
#include "trismooth/mesh_io/document/free_names.h"

namespace trismooth {

CgnsArrays plan_cgns_arrays(const std::vector<DataArray>& arrays, const GroupArrays& left_out) {
  CgnsArrays plan;
  FreeNames taken;
  std::vector<std::string> names;
  for (const DataArray& array : arrays) {
    if (left_out.has(array.name)) {
      continue;
    }
    const bool is_vector = array.components == 2 || array.components == 3;
    for (std::size_t k = 0; k < array.components; ++k) {
      std::string name = array.name;
      if (is_vector) {
        name += static_cast<char>('X' + k);
      } else if (array.components > 1) {
        name += "_" + std::to_string(k + 1);
      }
      names.push_back(taken.claim(name));
      plan.components.push_back({&array, k, {}});
    }
    if (array.components > 3) {
      plan.split.push_back(array.name + " (" + array.name + "_1 to " + array.name + "_" +
                           std::to_string(array.components) + ")");
    }
  }
  FittedNames fitted = fit_names(names, most_cgns_name_size, no_cgns_name_characters);
  for (std::size_t i = 0; i < names.size(); ++i) {
    plan.components[i].name = std::move(fitted.names[i]);
  }
  plan.renamed = std::move(fitted.renamed);
  return plan;
}

}  // namespace trismooth
