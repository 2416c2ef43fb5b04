// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_xml/vtk_array_description.h"

#include <algorithm>
#include <utility>

#include "trismooth/mesh_io/document/array_description.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_xml/vtk_information.h"
#include "trismooth/mesh_io/vtk_xml/vtk_messages.h"

namespace trismooth {

std::shared_ptr<const ArrayDescription> description_of(vtkAbstractArray& array) {
  ArrayDescription description;
  if (array.HasAComponentName()) {
    for (int i = 0; i < array.GetNumberOfComponents(); ++i) {
      const char* const name = array.GetComponentName(i);
      description.component_names.emplace_back(name == nullptr ? "" : name);
    }
  }
  if (array.HasInformation()) {
    description.information = information_as_text(*array.GetInformation());
  }
  return description.empty() ? nullptr : std::make_shared<const ArrayDescription>(std::move(description));
}

void describe(vtkAbstractArray& array, const ArrayDescription* description, std::vector<std::string>& losses) {
  if (description == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < description->component_names.size(); ++i) {
    if (!description->component_names[i].empty()) {
      array.SetComponentName(static_cast<vtkIdType>(i), description->component_names[i].c_str());
    }
  }
  if (!description->information.empty()) {
    const std::string name = array.GetName() == nullptr ? "without name" : array.GetName();
    set_information(description->information, name, *array.GetInformation(), losses);
  }
}

void add_roles(vtkDataSetAttributes& attributes, std::span<DataArray> views) {
  for (int role = 0; role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role) {
    vtkAbstractArray* const active = attributes.GetAbstractAttribute(role);
    const auto* const numbers =
        active == nullptr || active->GetNumberOfValues() == 0 ? nullptr : active->GetVoidPointer(0);
    const auto found = std::ranges::find_if(
        views, [numbers](const DataArray& view) { return numbers != nullptr && view.bytes.data() == numbers; });
    if (found != views.end()) {
      found->description = with_role(found->description.get(), vtkDataSetAttributes::GetAttributeTypeAsString(role));
    }
  }
}

void set_roles(std::span<const DataArray> arrays, vtkDataSetAttributes& attributes, std::vector<std::string>& losses) {
  VtkMessages messages;
  messages.watch(&attributes);
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (arrays[i].description == nullptr) {
      continue;
    }
    for (const std::string& role : arrays[i].description->roles) {
      int type = 0;
      while (type < vtkDataSetAttributes::NUM_ATTRIBUTES &&
             vtkDataSetAttributes::GetAttributeTypeAsString(type) != role) {
        ++type;
      }
      if (type == vtkDataSetAttributes::NUM_ATTRIBUTES || attributes.GetAbstractAttribute(type) != nullptr ||
          attributes.SetActiveAttribute(static_cast<int>(i), type) < 0) {
        losses.push_back("the array " + trismooth::quoted(arrays[i].name) + " is written, but not as active " + role);
      }
    }
  }
  messages.unwatch(&attributes);
}

bool has_id_role(const DataArray& array) {
  return array.description != nullptr && array.type == ScalarType::int64 &&
         std::ranges::any_of(array.description->roles,
                             [](const std::string& role) { return role == "GlobalIds" || role == "PedigreeIds"; });
}

}  // namespace trismooth
