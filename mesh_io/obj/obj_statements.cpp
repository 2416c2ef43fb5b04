// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/obj/obj_statements.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/text/blanks.h"

namespace trismooth {

bool is_obj_keyword(std::string_view token) {
  return std::ranges::all_of(token,
                             [](char c) {
                               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                                      c == '_';
                             }) &&
         !(token.front() >= '0' && token.front() <= '9');
}

std::size_t least_vertices(std::string_view keyword) {
  if (keyword == "f" || keyword == "fo") {
    return 3;
  }
  return keyword == "l" ? 2 : keyword == "p" ? 1 : 0;
}

std::uint8_t obj_cell_type(std::size_t least, std::size_t vertices) {
  switch (least) {
    case 1:
      return vertices == 1 ? cell_type::vertex : cell_type::poly_vertex;
    case 2:
      return vertices == 2 ? cell_type::line : cell_type::poly_line;
    default:
      return cell_type::of_face(vertices);
  }
}

void append_name(std::string& name, std::string_view line) {
  for (const std::string_view word : words_of(line)) {
    add_to_list(name, word, " ");
  }
}

void ObjStatements::add_other(std::string_view keyword) {
  if (others_.size() < most_named && !others_.contains(keyword)) {
    others_.emplace(keyword);
  }
}

void ObjStatements::move_to(MeshDocument& document) {
  materials_.move_to(document, "material");
  groups_.move_to(document, "group");
  std::string list = has_colours_or_weights_ ? "vertex colours or weights" : "";
  for (const std::string& keyword : others_) {
    add_to_list(list, keyword);
  }
  if (!list.empty()) {
    document.notes.push_back("Kept in OBJ output only: " + list + ".");
  }
}

void ObjStatements::CellNumbering::start(std::string name, std::size_t cells) {
  numbers_.resize(cells, current_);
  used_ = true;
  current_ = names_.try_emplace(std::move(name), static_cast<std::int32_t>(names_.size())).first->second;
}

void ObjStatements::CellNumbering::move_to(MeshDocument& document, std::string array_name) {
  if (!used_) {
    return;
  }
  numbers_.resize(document.cells.size(), current_);
  std::set<std::pair<std::int32_t, int>> used;
  std::pair<std::int32_t, int> last{-1, -1};
  for (std::size_t cell = 0; cell < numbers_.size(); ++cell) {
    const std::pair now{numbers_[cell], cell_type::dimension(document.cells.types[cell])};
    if (now != last) {
      used.insert(last = now);
    }
  }
  std::vector<const std::string*> names(names_.size());
  for (const auto& [name, number] : names_) {
    names[static_cast<std::size_t>(number)] = &name;
  }
  ArrayDescription description;
  for (const auto& [number, dimension] : used) {
    if (number >= 0 && !names[static_cast<std::size_t>(number)]->empty()) {
      description.value_names.push_back({number, dimension, *names[static_cast<std::size_t>(number)]});
    }
  }
  DataArray array = make_data_array(std::move(array_name), 1, std::move(numbers_));
  if (!description.empty()) {
    array.description = std::make_shared<const ArrayDescription>(std::move(description));
  }
  document.cell_arrays.push_back(std::move(array));
}

}  // namespace trismooth
