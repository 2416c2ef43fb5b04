#include "trismooth/mesh_io/medit/medit_content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "trismooth/mesh_io/document/format_losses.h"
#include "trismooth/mesh_io/document/point_labels.h"

namespace trismooth {

namespace {

constexpr std::string_view medit_title = "Medit";
constexpr std::string_view corners_set_name = "Corners";

/// Sets that Medit's reader makes of Required... sections.
bool is_required_set(const NamedSet& set) {
  return set.name == "RequiredVertices" || set.name == "RequiredEdges" || set.name == "RequiredTriangles" ||
         set.name == "RequiredQuadrilaterals";
}

/// Each once, ascending.
void keep_each_once(std::vector<std::int32_t>& vertices) {
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

std::vector<MeditContent::Section> medit_sections_of(const CellList& cells) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<MeditContent::Section> sections;
  std::array<std::size_t, 256> section_of{};
  section_of.fill(none);
  for (const MeditKeyword& keyword : medit_keywords()) {
    if (keyword.is_written) {
      section_of[keyword.cell_type] = sections.size();
      sections.push_back({&keyword, {}});
    }
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::size_t section = section_of[cells.types[cell]];
    if (section != none && cells[cell].size() == sections[section].keyword->vertices) {
      sections[section].cells.push_back(cell);
    }
  }
  std::erase_if(sections, [](const MeditContent::Section& section) { return section.cells.empty(); });
  return sections;
}

}  // namespace

MeditContent::MeditContent(const MeshDocument& from)
    : document(from),
      sections(medit_sections_of(from.cells)),
      groups(find_cell_groups(from)),
      vertex_refs(find_point_labels(from)) {
  for (std::size_t z = 2; z < document.points.size() && dimension == 2; z += 3) {
    dimension = document.points[z] != 0 || std::signbit(document.points[z]) ? 3 : 2;
  }
  for (const NamedSet& set : document.point_sets) {
    if (set.name == corners_set_name) {
      corners.insert(corners.end(), set.members.begin(), set.members.end());
    } else if (is_required_set(set)) {
      required_vertices.insert(required_vertices.end(), set.members.begin(), set.members.end());
    }
  }
  keep_each_once(corners);
  keep_each_once(required_vertices);
}

std::int64_t MeditContent::vertex_ref(std::size_t vertex) const {
  return vertex_refs == nullptr ? 0 : point_label(*vertex_refs, vertex);
}

std::int64_t MeditContent::cell_ref(std::size_t cell) const {
  if (groups.array.empty() || groups.of_cell[cell] < 0) {
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
  rest.cell_sets = document.cell_sets;
  std::ranges::copy_if(document.point_sets, std::back_inserter(rest.point_sets),
                       [](const NamedSet& set) { return set.name != corners_set_name && !is_required_set(set); });
  std::ranges::move(describe_lost_sets(medit_title, rest), std::back_inserter(sentences));
  return sentences;
}

}  // namespace trismooth
