// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_description.h"

#include <utility>

namespace trismooth {

std::shared_ptr<const ArrayDescription> with_role(const ArrayDescription* description, std::string role) {
  ArrayDescription extended = description == nullptr ? ArrayDescription() : *description;
  extended.roles.push_back(std::move(role));
  return std::make_shared<const ArrayDescription>(std::move(extended));
}

ArrayInformation unit_information(std::string unit) {
  return {"UNITS_LABEL", "vtkDataArray", {std::move(unit)}};
}

std::string unit_of(const DataArray& array) {
  if (array.description != nullptr) {
    for (const ArrayInformation& information : array.description->information) {
      if (information.name == unit_information({}).name && information.values.size() == 1) {
        return information.values.front();
      }
    }
  }
  return {};
}

void set_unit(DataArray& array, std::string unit) {
  if (!unit.empty()) {
    ArrayDescription extended = array.description == nullptr ? ArrayDescription() : *array.description;
    extended.information.push_back(unit_information(std::move(unit)));
    array.description = std::make_shared<const ArrayDescription>(std::move(extended));
  }
}

bool is_range_information(std::string_view name, std::string_view location) {
  return location == "vtkDataArray" && name.ends_with("_RANGE");
}

}  // namespace trismooth
