// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/point_labels.h"

namespace trismooth {

namespace {

constexpr std::string_view medit_title = "Medit";
constexpr std::string_view corners_set_name = "Corners";
constexpr std::string_view required_vertices_name = "RequiredVertices";
constexpr std::string_view ridges_name = "Ridges";

/// The keyword of a set of that name whose cells the document has as a set of cells, too; null: none.
const MeditKeyword* cell_set_keyword(std::string_view name) {
  const MeditKeyword* const keyword = find_medit_keyword(name);
  return keyword != nullptr && keyword->role == MeditRole::cell_set && keyword->name == name ? keyword : nullptr;
}

/// Sets of points that stand for cells that are required, or for these vertices themselves.
bool is_required_set(const NamedSet& set) {
  return set.name == required_vertices_name || (cell_set_keyword(set.name) != nullptr && set.name != ridges_name);
}

/// Members, each once, ascending.
std::vector<std::int64_t> numbers_from_1(std::vector<std::int32_t> members) {
  std::ranges::sort(members);
  members.erase(std::unique(members.begin(), members.end()), members.end());
  std::vector<std::int64_t> numbers;
  numbers.reserve(members.size());
  for (const std::int32_t member : members) {
    numbers.push_back(std::int64_t{member} + 1);
  }
  return numbers;
}

std::vector<MeditContent::Section> medit_sections_of(const CellList& cells, MeditContent::Source source) {
  std::vector<MeditContent::Section> sections;
  // Types of higher order have a section for every number of vertices.
  std::array<std::vector<std::size_t>, 256> sections_of{};
  for (const MeditKeyword& keyword : medit_keywords()) {
    const bool is_read = keyword.role == MeditRole::cells && source == MeditContent::Source::medit;
    if (keyword.is_written || is_read) {
      sections_of[keyword.cell_type].push_back(sections.size());
      sections.push_back({&keyword, {}});
    }
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const std::size_t section : sections_of[cells.types[cell]]) {
      if (cells[cell].size() == sections[section].keyword->vertices) {
        sections[section].cells.push_back(cell);
      }
    }
  }
  std::erase_if(sections, [](const MeditContent::Section& section) { return section.cells.empty(); });
  if (source == MeditContent::Source::medit) {
    // Cells keep their numbers.
    std::ranges::sort(sections, {}, [](const MeditContent::Section& section) { return section.cells.front(); });
  }
  return sections;
}

/// The numbers of the cells in the section that a keyword's numbers are of; nothing where one is not there.
std::optional<std::vector<std::int64_t>> numbers_in_section(const std::vector<MeditContent::Section>& sections,
                                                            const MeditKeyword& keyword, const NamedSet& set) {
  const auto of_type = [&sections](std::uint8_t type) {
    return std::ranges::find_if(
        sections, [type](const MeditContent::Section& section) { return section.keyword->cell_type == type; });
  };
  auto section = of_type(keyword.cell_type);
  section = section == sections.end() ? of_type(quadratic_medit_type(keyword.cell_type)) : section;
  std::vector<std::int32_t> places;
  for (const std::int32_t member : set.members) {
    const auto cell = static_cast<std::size_t>(member);
    if (section == sections.end() || !std::ranges::binary_search(section->cells, cell)) {
      return std::nullopt;
    }
    places.push_back(
        static_cast<std::int32_t>(std::ranges::lower_bound(section->cells, cell) - section->cells.begin()));
  }
  return numbers_from_1(std::move(places));
}

bool has_set(const std::vector<MeditContent::Set>& sets, const NamedSet& named) {
  return std::ranges::any_of(sets, [&named](const MeditContent::Set& set) { return set.keyword->name == named.name; });
}

}  // namespace

MeditContent::MeditContent(const MeshDocument& from, Source source)
    : document(from),
      sections(medit_sections_of(from.cells, source)),
      groups(find_cell_groups(from)),
      vertex_refs(find_point_labels(from)) {
  for (std::size_t z = 2; z < document.points.size() && dimension == 2; z += 3) {
    dimension = document.points[z] != 0 || std::signbit(document.points[z]) ? 3 : 2;
  }
  std::vector<Set> of_cells;
  for (const NamedSet& set : document.cell_sets) {
    if (const MeditKeyword* const keyword = cell_set_keyword(set.name); keyword != nullptr && !has_set(of_cells, set)) {
      if (auto numbers = numbers_in_section(sections, *keyword, set)) {
        of_cells.push_back({keyword, std::move(*numbers)});
      }
    }
  }
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> required_vertices;
  for (const NamedSet& set : document.point_sets) {
    if (set.name == corners_set_name) {
      corners.insert(corners.end(), set.members.begin(), set.members.end());
    } else if (is_required_set(set) && !has_set(of_cells, set)) {
      required_vertices.insert(required_vertices.end(), set.members.begin(), set.members.end());
    }
  }
  sets.push_back({find_medit_keyword(medit_code::corners), numbers_from_1(std::move(corners))});
  sets.push_back({find_medit_keyword(medit_code::required_vertices), numbers_from_1(std::move(required_vertices))});
  std::ranges::move(of_cells, std::back_inserter(sets));
  std::erase_if(sets, [](const Set& set) { return set.numbers.empty(); });
}

std::int64_t MeditContent::vertex_ref(std::size_t vertex) const {
  return vertex_refs == nullptr ? 0 : point_label(*vertex_refs, vertex);
}

std::int64_t MeditContent::cell_ref(std::size_t cell) const {
  if (groups.of_cell.empty() || groups.of_cell[cell] < 0) {
    return 0;
  }
  return groups.groups[static_cast<std::size_t>(groups.of_cell[cell])].number;
}

bool MeditContent::has_small_references() const {
  const auto is_small = [](std::int64_t reference) { return std::in_range<std::int32_t>(reference); };
  bool small = std::ranges::all_of(groups.groups, is_small, &CellGroup::number);
  for (std::size_t vertex = 0; vertex < document.point_count() && small && vertex_refs != nullptr; ++vertex) {
    small = is_small(vertex_ref(vertex));
  }
  return small;
}

std::vector<std::string> MeditContent::losses() const {
  std::vector<std::uint8_t> written_types;
  for (const MeditKeyword& keyword : medit_keywords()) {
    if (keyword.is_written) {
      written_types.push_back(keyword.cell_type);
    }
  }
  std::vector<std::string> sentences = describe_lost_cells(
      medit_title, "edges, triangles, quadrilaterals and their like", written_types, document.cells);
  std::ranges::move(describe_unlabelled_arrays(medit_title, document, vertex_refs, groups),
                    std::back_inserter(sentences));
  MeshDocument rest;
  std::ranges::copy_if(document.cell_sets, std::back_inserter(rest.cell_sets),
                       [this](const NamedSet& set) { return !has_set(sets, set); });
  std::string as_vertices;
  for (const NamedSet& set : document.point_sets) {
    if (has_set(sets, set) || set.name == corners_set_name || set.name == required_vertices_name) {
      continue;
    }
    if (is_required_set(set)) {
      add_to_list(as_vertices, set.name);
    } else {
      rest.point_sets.push_back(set);
    }
  }
  if (!as_vertices.empty()) {
    sentences.push_back("Medit gets the vertices of " + as_vertices + " as RequiredVertices");
  }
  std::ranges::move(describe_lost_sets(medit_title, rest), std::back_inserter(sentences));
  std::ranges::move(describe_new_order(medit_title, written_types, document.cells), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
