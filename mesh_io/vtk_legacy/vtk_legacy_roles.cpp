// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_roles.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_information.h"
#include "trismooth/mesh_io/vtk_legacy/vtk_legacy_names.h"

namespace trismooth {

namespace {

/// VTK reads lines of up to 255 characters.
constexpr std::size_t longest_text = 200;

bool can_hold(const ArrayInformation& information) {
  const auto kind = vtk_legacy_information_kind(information.name, information.location);
  const bool is_list = kind == InformationKind::numbers || kind == InformationKind::texts;
  return kind && (is_list || information.values.size() == 1) &&
         std::ranges::all_of(information.values, [kind](const std::string& value) {
           return encode_vtk_name(value).size() <= longest_text && (kind != InformationKind::text || !value.empty());
         });
}

std::string metadata_of(const ArrayInformation& information) {
  const auto kind = vtk_legacy_information_kind(information.name, information.location);
  std::string text = "NAME " + information.name + " LOCATION " + information.location + "\nDATA";
  if (kind == InformationKind::numbers || kind == InformationKind::texts) {
    text += " " + std::to_string(information.values.size());
  }
  for (const std::string& value : information.values) {
    text += kind == InformationKind::texts ? "\n" : " ";
    text += encode_vtk_name(value);
  }
  return text + "\n";
}

bool has_components(std::string_view role, std::size_t components) {
  return role == "Scalars"                        ? true
         : role == "Vectors" || role == "Normals" ? components == 3
         : role == "TCoords"                      ? components <= 3
         : role == "Tensors"                      ? components == 9 || components == 6
         : role == "EdgeFlag"                     ? components == 1
                                                  : false;
}

bool knows_role(const DataArray& array, std::string_view role, VtkLegacyData data) {
  return has_components(role, array.components) && (role != "EdgeFlag" || data == VtkLegacyData::points);
}

/// The first of its roles that the format knows; null where there is none.
const std::string* role_of(const DataArray& array, VtkLegacyData data) {
  if (array.description == nullptr) {
    return nullptr;
  }
  const std::vector<std::string>& own = array.description->roles;
  const auto found = std::ranges::find_if(own, [&](const std::string& role) { return knows_role(array, role, data); });
  return found == own.end() ? nullptr : &*found;
}

void add_lost_information(const std::string& name, const ArrayDescription* description,
                          std::vector<std::string>& sentences) {
  if (description == nullptr) {
    return;
  }
  for (const ArrayInformation& information : description->information) {
    if (!can_hold(information)) {
      sentences.push_back("the information " + information.location + "::" + information.name + " of the array " +
                          trismooth::quoted(name) + " is not kept");
    }
  }
}

void add_lost(std::span<const DataArray> arrays, VtkLegacyData data, std::vector<std::string>& sentences) {
  for (const DataArray& array : arrays) {
    add_lost_information(array.name, array.description.get(), sentences);
    if (array.description == nullptr) {
      continue;
    }
    const std::string* const kept = role_of(array, data);
    for (const std::string& role : array.description->roles) {
      if (&role != kept) {
        sentences.push_back("the array " + trismooth::quoted(array.name) + " is written, but not as active " + role);
      }
    }
  }
}

}  // namespace

std::optional<std::string> vtk_legacy_role_header(const DataArray& array, const std::string& encoded_name,
                                                  VtkLegacyData data) {
  const std::string* const role = role_of(array, data);
  if (role == nullptr) {
    return std::nullopt;
  }
  const std::string named = " " + encoded_name + " ";
  const std::string type(vtk_legacy_type_name(array.type));
  const std::string components = std::to_string(array.components);
  if (*role == "Scalars") {
    return "SCALARS" + named + type + " " + components + "\nLOOKUP_TABLE default\n";
  }
  if (*role == "TCoords") {
    return "TEXTURE_COORDINATES" + named + components + " " + type + "\n";
  }
  const std::string keyword = *role == "Vectors"      ? "VECTORS"
                              : *role == "Normals"    ? "NORMALS"
                              : *role == "EdgeFlag"   ? "EDGE_FLAGS"
                              : array.components == 6 ? "TENSORS6"
                                                      : "TENSORS";
  return keyword + named + type + "\n";
}

std::string vtk_legacy_metadata(const ArrayDescription* description) {
  if (description == nullptr) {
    return {};
  }
  std::string names;
  for (const std::string& name : description->component_names) {
    names += encode_vtk_name(name) + "\n";
  }
  std::string information;
  std::size_t count = 0;
  for (const ArrayInformation& entry : description->information) {
    if (can_hold(entry)) {
      information += metadata_of(entry);
      ++count;
    }
  }
  if (names.empty() && count == 0) {
    return {};
  }
  return "METADATA\n" + (names.empty() ? "" : "COMPONENT_NAMES\n" + names) +
         (count == 0 ? "" : "INFORMATION " + std::to_string(count) + "\n" + information) + "\n";
}

std::vector<std::string> lost_in_vtk_legacy(const MeshDocument& document) {
  std::vector<std::string> sentences;
  add_lost_information("Points", document.points_description.get(), sentences);
  add_lost(document.point_arrays, VtkLegacyData::points, sentences);
  add_lost(document.cell_arrays, VtkLegacyData::cells, sentences);
  for (const DataArray& array : document.field_arrays) {
    add_lost_information(array.name, array.description.get(), sentences);
  }
  return sentences;
}

}  // namespace trismooth
