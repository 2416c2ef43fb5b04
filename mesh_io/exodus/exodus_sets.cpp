// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/document/cells/listed_groups.h"
#include "trismooth/mesh_io/document/cells/name_without_type.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/exodus/exodus_blocks.h"
#include "trismooth/mesh_io/exodus/exodus_elements.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

struct Edge {
  std::array<std::int32_t, 2> ends;  ///< the lower first
  std::size_t set = 0;
  std::size_t cell = 0;
  std::size_t side = 0;  ///< from 0
};

class SetReader {
 public:
  SetReader(const NetcdfFile& file, const std::vector<ExodusBlock>& blocks, std::size_t axes, MeshDocument& document)
      : file_(file), blocks_(blocks), axes_(axes), document_(document) {}

  void read() {
    add_blocks();
    const std::size_t groups_of_blocks = groups_.size();
    read_side_sets();
    add_lines();
    for (std::size_t i = groups_of_blocks; i < groups_.size(); ++i) {
      std::vector<std::int32_t>& cells = groups_[i].cells;
      std::ranges::sort(cells);
      cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    }
    std::size_t place = 0;
    std::erase_if(groups_, [this, &place](const ListedGroup& group) {
      return with_others_.contains(place++) && group.cells.empty();
    });
    add_listed_groups("exodus:block", std::move(groups_), document_);
    if (are_joined_by_name_) {
      add_array("exodus:typed_block",
                [this](const ExodusBlock& block, std::size_t /*i*/) { return block_names_.id(block.number); });
    }
    add_element_ids();
    document_.cell_sets.insert(document_.cell_sets.end(), faces_.begin(), faces_.end());
    read_element_sets();
    read_node_sets();
    if (!with_other_sides_.empty()) {
      document_.notes.push_back(
          "Side sets have sides of other elements than faces and lines, which are kept in Exodus "
          "output only: " +
          with_other_sides_ + ".");
    }
  }

 private:
  [[noreturn]] void fail(const std::string& set, const std::string& message) const {
    throw ReadError(file_.path(), set + " " + message);
  }

  /// Blocks are regions, but for those that differ in the type of their elements alone, and those that the property
  /// says are none.
  void add_blocks() {
    const std::vector<std::string> keys = keys_of_blocks();
    std::map<std::string, std::size_t> places;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const ExodusBlock& block = blocks_[i];
      if (without_region_.contains(block.number)) {
        continue;
      }
      const auto [place, is_new] =
          keys[i].empty() ? std::pair(places.end(), true) : places.try_emplace(keys[i], groups_.size());
      if (is_new) {
        groups_.push_back(
            {block_names_.id(block.number),
             block.elements > 0 ? block_names_.name(block.number) : block_names_.name_or(block.number, "element block"),
             {}});
      }
      if (!block.has_cells) {
        with_others_.insert(groups_.size() - 1);
      }
      ListedGroup& group = is_new ? groups_.back() : groups_[place->second];
      if (!is_new && are_joined_by_name_) {
        group.name = name_without_type(group.name);
      }
      const std::size_t before = group.cells.size();
      group.cells.resize(before + (block.has_cells ? block.elements : 0));
      std::iota(group.cells.begin() + static_cast<std::ptrdiff_t>(before), group.cells.end(),
                static_cast<std::int32_t>(block.first_cell));
    }
    for (const std::size_t number : block_names_.without(file_, "connect")) {
      groups_.push_back({block_names_.id(number), block_names_.name_or(number, "element block"), {}});
    }
  }

  /// What blocks of one region have in common: their property, else their names but for the type of elements; empty for
  /// blocks that are a region of their own.
  std::vector<std::string> keys_of_blocks() {
    std::vector<std::string> keys(blocks_.size());
    const auto is_of_faces = [this](const ExodusBlock& block) {
      return block.has_cells && block.elements > 0 &&
             cell_type::dimension(document_.cells.types[block.first_cell]) == 2;
    };
    if (const NetcdfVariable* const property = region_property()) {
      const std::vector<std::int64_t> regions = file_.values<std::int64_t>(*property);
      for (std::size_t i = 0; i < blocks_.size(); ++i) {
        if (blocks_[i].number > regions.size()) {
          continue;
        }
        if (const std::int64_t region = regions[blocks_[i].number - 1]; region == 0) {
          without_region_.insert(blocks_[i].number);
        } else if (is_of_faces(blocks_[i])) {
          keys[i] = std::to_string(region);
        }
      }
      return keys;
    }
    std::map<std::string, std::vector<std::size_t>> alike;
    bool has_names = false;
    std::set<std::string> types;
    std::size_t of_faces = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (is_of_faces(blocks_[i])) {
        const std::string name = block_names_.name(blocks_[i].number);
        has_names = has_names || !name.empty();
        types.insert(upper_case(blocks_[i].type));
        ++of_faces;
        if (const std::string rest = lower_case(name_without_type(name)); !name.empty()) {
          alike[rest].push_back(i);
        }
      }
    }
    for (const auto& [name, members] : alike) {
      std::set<std::string> own;
      if (members.size() > 1 &&
          std::ranges::all_of(members, [&](std::size_t i) { return own.insert(upper_case(blocks_[i].type)).second; })) {
        std::ranges::for_each(members, [&, &key = name](std::size_t i) { keys[i] = "name " + key; });
        are_joined_by_name_ = true;
      }
    }
    if (!has_names && of_faces > 1 && types.size() == of_faces) {
      document_.notes.emplace_back(
          "The element blocks have no names, and each another type of elements: if they are one region, --region-array "
          "none frees what is between them.");
    }
    return keys;
  }

  const NetcdfVariable* region_property() const {
    for (const auto& [number, property] : numbered_variables(file_, "eb_prop")) {
      if (property->text_of("name") == exodus_region_name) {
        return property;
      }
    }
    return nullptr;
  }

  /// An array of whole numbers with value(block, element in it); 0 for the lines of side sets.
  template <class Value>
  void add_array(const std::string& name, const Value& value) {
    std::vector<std::int64_t> values(document_.cells.size());
    for (const ExodusBlock& block : blocks_) {
      for (std::size_t i = 0; block.has_cells && i < block.elements; ++i) {
        values[block.first_cell + i] = value(block, i);
      }
    }
    document_.cell_arrays.push_back(make_data_array(name, 1, std::move(values)));
  }

  /// The ids of elements where they do not count on from 1.
  void add_element_ids() {
    for (const char* const name : {"elem_num_map", "elem_map"}) {
      const NetcdfVariable* const map = file_.find(name);
      if (map == nullptr || map->shape != std::vector{element_count()}) {
        continue;
      }
      const std::vector<std::int64_t> ids = file_.values<std::int64_t>(*map);
      std::int64_t next = 1;
      if (!std::ranges::all_of(ids, [&next](std::int64_t id) { return id == next++; })) {
        add_array("exodus:element_id",
                  [&ids](const ExodusBlock& block, std::size_t i) { return ids[block.first_element + i]; });
      }
      return;
    }
  }

  /// The numbers of a list, from 0; each is below `most`.
  std::vector<std::int64_t> numbers_of(const NetcdfVariable& variable, const std::string& set, std::size_t most,
                                       const std::string& what) const {
    std::vector<std::int64_t> numbers = file_.values<std::int64_t>(variable);
    for (std::int64_t& number : numbers) {
      if (number < 1 || static_cast<std::uint64_t>(number) > most) {
        fail(set, "names " + what + " " + std::to_string(number) + ", of " + std::to_string(most));
      }
      --number;
    }
    return numbers;
  }

  std::size_t element_count() const {
    return blocks_.empty() ? 0 : blocks_.back().first_element + blocks_.back().elements;
  }

  const ExodusBlock& block_of(std::size_t element) const {
    return *std::prev(std::ranges::upper_bound(blocks_, element, {}, &ExodusBlock::first_element));
  }

  /// The cell of an element; nothing where it is none.
  std::optional<std::size_t> cell_of(std::size_t element) const {
    const ExodusBlock& block = block_of(element);
    return block.has_cells ? std::optional(block.first_cell + element - block.first_element) : std::nullopt;
  }

  void read_side_sets() {
    struct Sides {
      std::size_t number;
      std::vector<std::int64_t> elements;
      std::vector<std::int64_t> sides;
    };
    const ExodusNames names(file_, "ss_prop1", "ss_names");
    std::vector<Sides> sets;
    std::int64_t highest = 0;
    std::int64_t lowest = 2;
    for (const auto& [number, elements] : numbered_variables(file_, "elem_ss")) {
      const std::string set = "side set " + std::to_string(number);
      const NetcdfVariable* const sides = file_.find("side_ss" + std::to_string(number));
      Sides& read = sets.emplace_back(Sides{number, numbers_of(*elements, set, element_count(), "element"), {}});
      constexpr std::size_t most_sides = 1'000'000;  // of a polygon
      read.sides = sides == nullptr ? read.sides : numbers_of(*sides, set, most_sides, "side");
      if (read.sides.size() != read.elements.size()) {
        fail(set, "has not as many sides as elements");
      }
      for (std::size_t i = 0; i < read.sides.size(); ++i) {
        if (is_triangle_in_space(static_cast<std::size_t>(read.elements[i]))) {
          highest = std::max(highest, read.sides[i]);
          lowest = std::min(lowest, read.sides[i]);
        }
      }
    }
    for (const std::size_t number : names.without(file_, "elem_ss")) {
      sets.push_back({number, {}, {}});
    }
    // The first two sides of a triangle in space are its faces; where there are three sides at most, and one of these
    // two and the third both occur, who wrote the file numbered the edges alone.
    const bool has_first_faces = !(highest == 2 && lowest < 2);
    for (const Sides& set : sets) {
      const std::size_t place = groups_.size();
      groups_.push_back({names.id(set.number), names.name_or(set.number, "side set"), {}});
      for (std::size_t i = 0; i < set.sides.size(); ++i) {
        add_side(place, static_cast<std::size_t>(set.elements[i]), static_cast<std::size_t>(set.sides[i]),
                 has_first_faces);
      }
    }
  }

  bool is_triangle_in_space(std::size_t element) const {
    const ExodusBlock& block = block_of(element);
    const auto cell = cell_of(element);
    return cell && exodus_corners(document_.cells.types[*cell], 0) == 3 && begins_with_faces(block.type, axes_);
  }

  void add_side(std::size_t group, std::size_t element, std::size_t side, bool has_first_faces) {
    const auto cell = cell_of(element);
    const std::uint8_t type = cell ? document_.cells.types[*cell] : cell_type::poly_vertex;
    const std::size_t corners = cell ? exodus_corners(type, document_.cells[*cell].size()) : 0;
    if (corners == 0) {
      if (cell_type::dimension(type) == 1) {
        groups_[group].cells.push_back(static_cast<std::int32_t>(*cell));
      } else if (with_others_.insert(group).second) {
        add_to_list(with_other_sides_, groups_[group].name);
      }
      return;
    }
    const std::string& of_elements = block_of(element).type;
    const std::size_t faces = begins_with_faces(of_elements, axes_) && (corners != 3 || has_first_faces) ? 2 : 0;
    if (side < faces) {
      if (faces_.empty() || last_of_faces_ != group) {
        faces_.push_back({groups_[group].name, {}});
        last_of_faces_ = group;
        with_others_.insert(group);
      }
      faces_.back().members.push_back(static_cast<std::int32_t>(*cell));
      return;
    }
    if (side - faces >= corners) {
      fail(trismooth::quoted(groups_[group].name), "names side " + std::to_string(side + 1) + " of element " +
                                                       std::to_string(element + 1) + ", which it has not");
    }
    const auto vertices = document_.cells[*cell];
    const std::int32_t a = vertices[side - faces];
    const std::int32_t b = vertices[(side - faces + 1) % corners];
    edges_.push_back({{std::min(a, b), std::max(a, b)}, group, *cell, side - faces});
  }

  /// An edge that several sets have, or that two elements have, is one line.
  void add_lines() {
    std::vector<std::size_t> order(edges_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [this](std::size_t i) { return std::pair(edges_[i].ends, i); });
    std::vector<std::size_t> first(edges_.size());  // of the same edge
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_same = i > 0 && edges_[order[i]].ends == edges_[order[i - 1]].ends;
      first[order[i]] = is_same ? first[order[i - 1]] : order[i];
    }
    std::vector<std::int32_t> line_of(edges_.size());
    CellList& cells = document_.cells;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (first[i] == i) {
        line_of[i] = static_cast<std::int32_t>(cells.size());
        append_line(edges_[i]);
      }
      groups_[edges_[i].set].cells.push_back(line_of[first[i]]);
    }
  }

  void append_line(const Edge& edge) {
    CellList& cells = document_.cells;
    if (cells.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw ReadError(file_.path(), "has more elements and sides than 32-bit indices can tell apart");
    }
    const std::uint8_t type = cells.types[edge.cell];
    const auto vertices = cells[edge.cell];
    const std::size_t corners = exodus_corners(type, vertices.size());
    std::array<std::int32_t, 3> line{vertices[edge.side], vertices[(edge.side + 1) % corners], 0};
    const bool is_curved = type != cell_type::polygon && vertices.size() >= 2 * corners;
    if (is_curved) {
      line[2] = vertices[corners + edge.side];
    }
    cells.append(is_curved ? cell_type::quadratic_edge : cell_type::line, std::span(line).first(is_curved ? 3 : 2));
  }

  /// Adds those of the sets that have no members.
  void add_empty_sets(const ExodusNames& names, const std::string& variable, std::string_view what,
                      std::vector<NamedSet>& sets) const {
    for (const std::size_t number : names.without(file_, variable)) {
      sets.push_back({names.name_or(number, what), {}});
    }
  }

  void read_element_sets() {
    const ExodusNames names(file_, "els_prop1", "els_names");
    for (const auto& [number, elements] : numbered_variables(file_, "elem_els")) {
      NamedSet& set = document_.cell_sets.emplace_back();
      set.name = names.name_or(number, "element set");
      for (const std::int64_t element :
           numbers_of(*elements, "element set " + std::to_string(number), element_count(), "element")) {
        if (const auto cell = cell_of(static_cast<std::size_t>(element))) {
          set.members.push_back(static_cast<std::int32_t>(*cell));
        }
      }
    }
    add_empty_sets(names, "elem_els", "element set", document_.cell_sets);
  }

  void read_node_sets() {
    const ExodusNames names(file_, "ns_prop1", "ns_names");
    for (const auto& [number, nodes] : numbered_variables(file_, "node_ns")) {
      NamedSet& set = document_.point_sets.emplace_back();
      set.name = names.name_or(number, "node set");
      const std::vector<std::int64_t> members =
          numbers_of(*nodes, "node set " + std::to_string(number), document_.point_count(), "node");
      set.members.assign(members.begin(), members.end());
    }
    add_empty_sets(names, "node_ns", "node set", document_.point_sets);
  }

  const NetcdfFile& file_;
  const std::vector<ExodusBlock>& blocks_;
  std::size_t axes_;
  MeshDocument& document_;
  const ExodusNames block_names_{file_, "eb_prop1", "eb_names"};
  bool are_joined_by_name_ = false;
  std::set<std::size_t> without_region_;  ///< numbers of blocks that are no region
  std::vector<ListedGroup> groups_;       ///< blocks, then side sets
  std::set<std::size_t> with_others_;     ///< places of those that have what is no cell
  std::vector<Edge> edges_;
  std::vector<NamedSet> faces_;  ///< side sets of faces of shells
  std::size_t last_of_faces_ = 0;
  std::string with_other_sides_;
};

}  // namespace

void add_exodus_sets(const NetcdfFile& file, const std::vector<ExodusBlock>& blocks, std::size_t axes,
                     MeshDocument& document) {
  SetReader(file, blocks, axes, document).read();
}

}  // namespace trismooth
