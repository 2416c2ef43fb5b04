// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "trismooth/base/text/counted.h"
#include "trismooth/mesh_io/document/number_sites.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Every statement begins with a word of letters, digits and underscores.
bool is_obj_keyword(std::string_view token);

/// The fewest vertices of the element that the keyword (f, l, p and the obsolete fo) states; 0 of all other keywords.
std::size_t least_vertices(std::string_view keyword);

/// The cell type of an element with that least number of vertices.
std::uint8_t obj_cell_type(std::size_t least, std::size_t vertices);

/// Reads the rest of a statement "v": x y z, and a weight or a colour, or both, which are told by `has_more`. There is
/// room for the vertex. Numbers are plain or careful (see PlainSource).
template <class Numbers>
bool read_obj_vertex(Numbers& numbers, std::size_t vertex, MeshDocument& document, NumberSites& sites, bool& has_more) {
  std::size_t count = 0;
  for (; !numbers.at_end_of_line(); ++count) {
    double value = 0;
    if (!numbers.next_real(value, "a number of a vertex")) {
      return false;
    }
    if (count < 3) {
      document.points[3 * vertex + count] = value;
      sites.offsets[3 * vertex + count] = numbers.token_offset();
    }
  }
  has_more = has_more || count > 3;
  return count == 3 || count == 4 || count == 6 || count == 7 || numbers.fail([&](std::string_view /*number*/) {
    return "vertex " + std::to_string(vertex + 1) + ": expected 3 coordinates (and a weight, a colour or both), got " +
           counted(count, "number", "numbers");
  });
}

/// Appends the words of a line to a name, in which words are one blank apart.
void append_name(std::string& name, std::string_view line);

/// What statements beside vertices and elements say of the mesh; told in the file's order.
class ObjStatements {
 public:
  /// A statement usemtl, or g, with this name stands after `cells` cells.
  void start_material(std::string name, std::size_t cells) { materials_.start(std::move(name), cells); }
  void start_group(std::string name, std::size_t cells) { groups_.start(std::move(name), cells); }

  /// A statement that stays in the bytes that are written back; of the keyword a copy is kept.
  void add_other(std::string_view keyword);
  void add_colours_or_weights() { has_colours_or_weights_ = true; }

  /// Adds the cell arrays and the note.
  void move_to(MeshDocument& document);

  static constexpr std::size_t most_named = 16;  ///< some "OBJ" files are something else altogether

 private:
  /// The numbers of the cells by the statement that stands before them.
  class CellNumbering {
   public:
    void start(std::string name, std::size_t cells);
    /// Adds the array of all cells, with the names of its numbers, if there was any statement.
    void move_to(MeshDocument& document, std::string array_name);

   private:
    std::map<std::string, std::int32_t, std::less<>> names_;
    std::vector<std::int32_t> numbers_;
    std::int32_t current_ = -1;
    bool used_ = false;
  };

  CellNumbering materials_;
  CellNumbering groups_;
  std::set<std::string, std::less<>> others_;
  bool has_colours_or_weights_ = false;
};

}  // namespace trismooth
