// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/medit/medit_mesh.h"

#include <algorithm>
#include <set>
#include <span>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_resize.h"
#include "trismooth/mesh_io/document/cells/uniform_cells.h"
#include "trismooth/mesh_io/document/integer_array.h"

namespace trismooth {

namespace {

constexpr std::size_t most_medit_others = 10;

std::string_view name_of_medit_cells(std::uint8_t type) {
  return type == cell_type::line ? "edges" : type == cell_type::triangle ? "triangles" : "quadrilaterals";
}

}  // namespace

void MeditMesh::set_dimension(std::size_t dimension) {
  dimension_ = dimension;
  sites.columns.resize(dimension);
}

void MeditMesh::resize_vertices(std::size_t count) {
  has_vertices = true;
  shared_resize(document.points, 3 * count, sites.offsets, dimension_ * count, workers_.workers);
  shared_resize(vertex_refs, count, workers_.workers);
}

std::size_t MeditMesh::append_cells(const MeditKeyword& keyword, std::size_t count) {
  const std::size_t first = append_uniform_cells(document.cells, keyword.cell_type, keyword.vertices, count, workers_);
  shared_resize(cell_refs, first + count, workers_.workers);
  sections_.push_back({keyword.cell_type, first, count});
  return first;
}

void MeditMesh::add_other(std::string_view name) {
  if (others_.size() <= most_medit_others && std::ranges::find(others_, name) == others_.end()) {
    others_.emplace_back(others_.size() < most_medit_others ? name : "others");
  }
}

std::vector<std::size_t> MeditMesh::cells_of_type(std::uint8_t type) const {
  std::vector<std::size_t> cells;
  for (const Section& section : sections_) {
    if (section.type == type) {
      for (std::size_t cell = section.first; cell < section.first + section.count; ++cell) {
        cells.push_back(cell);
      }
    }
  }
  return cells;
}

std::optional<MeditMesh::WrongNumber> MeditMesh::make_set(const Set& set) {
  NamedSet named{std::string(set.keyword->name), {}};
  NamedSet cells = named;  // of a set of cells these themselves
  const bool of_cells = set.keyword->role == MeditRole::cell_set;
  std::vector<std::size_t> numbered;
  if (of_cells) {
    const std::uint8_t type = set.keyword->cell_type;
    numbered = cells_of_type(type);
    if (numbered.empty()) {
      numbered = cells_of_type(quadratic_medit_type(type));
    }
  }
  const std::size_t count = of_cells ? numbered.size() : document.point_count();
  for (std::size_t i = 0; i < set.numbers.size(); ++i) {
    const std::int64_t number = set.numbers[i];
    if (number < 1 || static_cast<std::uint64_t>(number) > count) {
      return WrongNumber{&set, i, count, of_cells ? name_of_medit_cells(set.keyword->cell_type) : "vertices"};
    }
    if (!of_cells) {
      named.members.push_back(static_cast<std::int32_t>(number - 1));
      continue;
    }
    const std::size_t cell = numbered[static_cast<std::size_t>(number - 1)];
    cells.members.push_back(static_cast<std::int32_t>(cell));
    const auto vertices = document.cells[cell];
    named.members.insert(named.members.end(), vertices.begin(), vertices.end());
  }
  if (of_cells) {
    std::ranges::sort(named.members);
    named.members.erase(std::unique(named.members.begin(), named.members.end()), named.members.end());
    document.cell_sets.push_back(std::move(cells));
  }
  document.point_sets.push_back(std::move(named));
  return std::nullopt;
}

std::optional<MeditMesh::WrongNumber> MeditMesh::finish() {
  for (const Set& set : sets_) {
    if (const auto wrong = make_set(set)) {
      return wrong;
    }
  }
  // 0 is what all have where a file tells nothing apart.
  const auto says_anything = [](std::span<const std::int64_t> refs) {
    return std::ranges::any_of(refs, [](std::int64_t ref) { return ref != 0; });
  };
  if (says_anything(vertex_refs)) {
    document.point_arrays.push_back(make_integer_array("medit:ref", std::move(vertex_refs)));
  }
  if (says_anything(cell_refs)) {
    document.cell_arrays.push_back(make_integer_array("medit:ref", std::move(cell_refs)));
  }
  std::set<std::uint8_t> types;
  for (const Section& section : sections_) {
    types.insert(section.type);
  }
  if (types.size() < sections_.size()) {
    document.notes.emplace_back(
        "Cells of a type stand in several sections: Medit output that is text where the input is binary, or the other "
        "way round, has one section of each, and so another order of cells.");
  }
  if (!has_end) {
    document.notes.emplace_back("The file has no End: nothing says whether something is missing there.");
  }
  if (!others_.empty()) {
    document.notes.push_back(
        "Kept in Medit output only, where it is text or binary as the input is: " + list_text(others_) + ".");
  }
  return std::nullopt;
}

}  // namespace trismooth
