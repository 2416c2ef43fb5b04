// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_description.h"

#include <utility>

namespace trismooth {

std::shared_ptr<const ArrayDescription> with_role(const ArrayDescription* description, std::string role) {
  ArrayDescription extended = description == nullptr ? ArrayDescription() : *description;
  extended.roles.push_back(std::move(role));
  return std::make_shared<const ArrayDescription>(std::move(extended));
}

bool is_range_information(std::string_view name, std::string_view location) {
  return location == "vtkDataArray" && name.ends_with("_RANGE");
}

}  // namespace trismooth
