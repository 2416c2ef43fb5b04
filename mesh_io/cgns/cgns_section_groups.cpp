// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_section_groups.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/mesh_io/cgns/cgns_elements.h"
#include "trismooth/mesh_io/document/cells/name_without_type.h"

namespace trismooth {

namespace {

bool has_faces(const CgnsSection& section, const CellList& cells) {
  return section.count > 0 && cell_type::dimension(cells.types[section.first_cell]) == 2;
}

std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) { return '0' <= c && c <= '9'; });
  return text;
}

bool have_different_types(const std::vector<const CgnsSection*>& sections) {
  std::set<std::int64_t> types;
  return std::ranges::all_of(sections,
                             [&types](const CgnsSection* section) { return types.insert(section->type).second; });
}

}  // namespace

CgnsSectionGroups group_cgns_sections(const CgnsSections& sections, const CellList& cells) {
  std::vector<const CgnsSection*> faces;
  std::map<std::string, std::vector<const CgnsSection*>> by_name;
  std::set<std::string> names_without_numbers;
  for (const CgnsSection& section : sections.all()) {
    if (has_faces(section, cells)) {
      faces.push_back(&section);
      const std::string name = lower_case(name_without_type(section.name));
      by_name[name].push_back(&section);
      names_without_numbers.insert(without_digits(name));
    }
  }
  const bool are_one = faces.size() > 1 && names_without_numbers.size() == 1 && have_different_types(faces);
  CgnsSectionGroups found;
  // Names of numbers of types say nothing besides.
  found.are_joined = are_one && !std::ranges::all_of(faces, [](const CgnsSection* section) {
                       return section->name == cgns_section_name(section->type);
                     });
  std::map<std::string, std::size_t> places;
  for (const CgnsSection& section : sections.all()) {
    std::string name = section.name;
    if (has_faces(section, cells)) {
      if (are_one) {
        continue;
      }
      const std::string rest = name_without_type(name);
      const auto& alike = by_name.at(lower_case(rest));
      if (!rest.empty() && alike.size() > 1 && have_different_types(alike)) {
        name = name_without_type(alike.front()->name);
        found.are_joined = true;
      }
    }
    const auto [place, is_new] = places.try_emplace(name, found.groups.size());
    if (is_new) {
      found.groups.push_back({name, {}});
    }
    std::vector<std::int32_t>& members = found.groups[place->second].members;
    const auto begin = static_cast<std::ptrdiff_t>(members.size());
    members.resize(members.size() + section.count);
    std::iota(members.begin() + begin, members.end(), static_cast<std::int32_t>(section.first_cell));
  }
  std::erase_if(found.groups, [](const NamedSet& group) { return group.members.empty(); });
  return found;
}

}  // namespace trismooth
