// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_elements.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/msh/msh_element_types.h"
#include "trismooth/mesh_io/msh/msh_repeated_elements.h"
#include "trismooth/mesh_io/msh/msh_row_tags.h"

namespace trismooth {

namespace {

constexpr std::size_t msh_int_bytes = sizeof(std::int32_t);

class MshElementReader {
 public:
  MshElementReader(MshInput& input, MshRows& rows, const MshTags& nodes, MshEntities& entities, MeshDocument& document,
                   MshElements& elements)
      : input_(input),
        rows_(rows),
        nodes_(nodes),
        entities_(entities),
        cells_(document.cells),
        elements_(elements),
        budget_(input.path(), input.bytes().size()) {}

  void read_blocks() {
    const bool of_4_1 = input_.header().version >= 41;
    const std::int64_t blocks = input_.size("the number of blocks of elements");
    element_count_ = static_cast<std::size_t>(input_.size("the number of elements", largest_msh_int));
    count_offset_ = input_.number_offset();
    if (of_4_1) {
      input_.size("the smallest tag of an element");
      input_.size("the largest tag of an element");
    }
    input_.require_room("elements", element_count_, 2, 2 * msh_int_bytes);
    reserve();
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t first = input_.integer("a dimension or a tag of an entity", -largest_msh_int, largest_msh_int);
      const std::int64_t second =
          input_.integer("a dimension or a tag of an entity", -largest_msh_int, largest_msh_int);
      const std::int64_t dimension = of_4_1 ? first : second;
      if (dimension < 0 || dimension > 3) {
        input_.fail("expected the dimension of an entity, 0 to 3, got " + std::to_string(dimension));
      }
      const MshElementType& type = next_type();
      const auto count = static_cast<std::size_t>(input_.size("the number of elements of a block", largest_msh_int));
      if (count > element_count_ - cells_.size()) {
        fail_count(std::to_string(cells_.size() + count) + " or more");
      }
      read_block(entities_(static_cast<int>(dimension), of_4_1 ? second : first), static_cast<int>(dimension), type,
                 count);
    }
    require_all();
    finish();
  }

  /// Of version 2; its length is text in binary files too.
  void read_list() {
    begin_list();
    if (input_.header().binary) {
      input_.text().next_line();
      reserve_labels();
      while (cells_.size() < element_count_) {
        read_binary_group();
      }
    } else if (element_count_ == 0 || !read_plain_list()) {
      read_text_list();
    }
    elements_.tags.add(tag_list_);
    finish_list();
  }

  /// Of version 1.
  void read_list_of_version_1() {
    begin_list();
    reserve_labels();
    while (cells_.size() < element_count_) {
      tag_list_.push_back(input_.integer("the tag of an element", 0, largest_msh_int));
      const MshElementType& type = next_type();
      read_labels(2);
      const std::int64_t vertices = input_.integer("the number of nodes of an element", 0, largest_msh_int);
      if (static_cast<std::size_t>(vertices) != type.vertices) {
        input_.fail("elements of type " + std::to_string(type_number_) + " have " + std::to_string(type.vertices) +
                    " nodes, got " + std::to_string(vertices));
      }
      read_vertices(type);
    }
    elements_.tags.add(tag_list_);
    finish_list();
  }

 private:
  const MshElementType& next_type() {
    type_number_ = input_.integer("the type of an element", 0, largest_msh_int);
    const MshElementType& type = msh_element_type(type_number_);
    if (type.vertices == 0 && !(is_msh_polygon(type_number_) && !input_.header().binary &&
                                input_.header().version < 40 && input_.header().version >= 20)) {
      input_.fail("elements of type " + std::to_string(type_number_) + " are not supported");
    }
    return type;
  }

  void begin_list() {
    element_count_ = static_cast<std::size_t>(input_.text().next_integer("the number of elements", 0, largest_msh_int));
    count_offset_ = input_.number_offset();
    input_.require_room("elements", element_count_, 4, 3 * msh_int_bytes);
    reserve();
  }

  /// For elements that are read one by one.
  void reserve_labels() {
    elements_.physical.reserve(element_count_);
    elements_.geometrical.reserve(element_count_);
    elements_.partition.reserve(element_count_);
    tag_list_.reserve(element_count_);
  }

  [[noreturn]] void fail_count(const std::string& got) const {
    input_.fail_at(count_offset_, "expected " + std::to_string(element_count_) + " elements, got " + got);
  }

  void reserve() {
    shared_reserve(cells_.offsets, element_count_ + 1, rows_.workers().workers);
    shared_reserve(cells_.types, element_count_, rows_.workers().workers);
  }

  void require_all() const {
    if (cells_.size() != element_count_) {
      fail_count(std::to_string(cells_.size()));
    }
  }

  void read_block(const MshEntity& entity, int dimension, const MshElementType& type, std::size_t count) {
    const MshTagKind kind = tag_kind_of(input_.header());
    const std::size_t numbers = 1 + type.vertices;
    input_.require_room("elements in a block", count, numbers, numbers * tag_bytes(kind));
    const std::size_t first = cells_.size();
    const std::size_t first_vertex = cells_.connectivity.size();
    Workers& workers = rows_.workers().workers;
    grow_shared(cells_.connectivity, first_vertex + count * type.vertices, cells_.offsets, first + 1 + count, workers);
    cells_.types.resize(first + count, type.cell);
    const auto begin_cell = [&](std::size_t row) {
      cells_.offsets[first + row + 1] = static_cast<std::int64_t>(first_vertex + (row + 1) * type.vertices);
      return cells_.connectivity.data() + first_vertex + row * type.vertices;
    };
    const MshRowLayout layout{count, numbers, numbers * tag_bytes(kind)};
    MshRowTags tags(kind, count);
    const std::optional<MshTags::Run> run = nodes_.only_run();
    const bool plain =
        run && is_triangle(type)
            ? tags.read(rows_, input_, elements_.tags,
                        [&](auto tag) {
                          return rows_.read(layout, [&](auto& part, std::size_t begin, std::size_t end) {
                            return next_triangles<decltype(tag)>(part, tags, *run, begin, end, begin_cell);
                          });
                        })
            : tags.read(rows_, input_, layout, elements_.tags, [&](auto& row_numbers, std::size_t row, auto tag) {
                return next_vertices<decltype(tag)>(row_numbers, type, begin_cell(row));
              });
    if (!plain) {
      tag_list_.clear();
      for (std::size_t row = 0; row < count; ++row) {
        tag_list_.push_back(next_element_or_node_tag("the tag of an element"));
        next_vertices<std::int64_t>(input_, type, begin_cell(row));
      }
      elements_.tags.add(tag_list_);
    }
    add_label(elements_.geometrical, first, count, entity.geometrical);
    add_label(elements_.physical, first, count, entity.physical.empty() ? 0 : entity.physical.front());
    add_label(elements_.partition, first, count, entity.partition);
    for (std::size_t i = 1; i < entity.physical.size(); ++i) {
      budget_.spend(count);
      std::vector<std::int32_t>& members = elements_.further_groups[{dimension, entity.physical[i]}];
      for (std::size_t cell = first; cell < first + count; ++cell) {
        members.push_back(static_cast<std::int32_t>(cell));
      }
    }
  }

  /// Of `count` elements from number `first` on. Labels that are 0 in the whole file take no memory.
  void add_label(std::vector<std::int32_t>& labels, std::size_t first, std::size_t count, std::int32_t label) {
    if (label == 0 && labels.empty()) {
      return;
    }
    if (labels.empty()) {
      shared_reserve(labels, element_count_, rows_.workers().workers);
    }
    labels.resize(first);
    labels.resize(first + count, label);
  }

  std::int64_t next_element_or_node_tag(std::string_view what) {
    return input_.header().version >= 41 ? input_.size(what) : input_.integer(what, 0, largest_msh_int);
  }

  /// Of the next element of a list, which has been begun.
  void read_vertices(const MshElementType& type) {
    const std::size_t begin = cells_.connectivity.size();
    cells_.connectivity.resize(begin + type.vertices);
    next_vertices<std::int64_t>(input_, type, cells_.connectivity.data() + begin);
    cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
    cells_.types.push_back(type.cell);
  }

  /// Numbers behind the type of an element: its group, its entity, its partitions.
  using FirstLabels = std::array<std::int64_t, 4>;

  void read_labels(std::size_t count) {
    const std::size_t element = elements_.physical.size();
    elements_.physical.push_back(0);
    elements_.geometrical.push_back(0);
    elements_.partition.push_back(0);
    next_labels(input_, element, count);
  }

  void set_labels(std::size_t element, const FirstLabels& first, std::size_t count) {
    elements_.physical[element] = static_cast<std::int32_t>(std::abs(first[0]));
    elements_.geometrical[element] = static_cast<std::int32_t>(first[1]);
    // From version 2.2 on the number of partitions stands before them.
    const bool counted = input_.header().version >= 22;
    elements_.partition[element] = static_cast<std::int32_t>(!counted                    ? first[2]
                                                             : count > 3 && first[2] > 0 ? first[3]
                                                                                         : 0);
  }

  void read_text_list() {
    reserve_labels();
    while (cells_.size() < element_count_) {
      tag_list_.push_back(input_.integer("the tag of an element", 0, largest_msh_int));
      const MshElementType* type = &next_type();
      const std::int64_t labels = input_.integer("the number of tags of an element", 0, largest_msh_int);
      read_labels(static_cast<std::size_t>(labels));
      MshElementType polygon;
      if (type->vertices == 0) {
        polygon = {2,
                   static_cast<std::size_t>(input_.integer("the number of vertices of a polygon", 3, largest_msh_int))};
        input_.require_room("vertices of a polygon", polygon.vertices, 1, msh_int_bytes);
        polygon.cell = cell_type::of_face(polygon.vertices);
        type = &polygon;
      }
      read_vertices(*type);
    }
  }

  /// Rows of elements that have equally many labels: by all workers. False where anything is unusual: nothing has
  /// changed then.
  bool read_plain_list() {
    PlainNumbers first_row(input_.bytes(), input_.offset());
    std::array<std::int32_t, 3> head{};  // tag, type and number of labels
    if (!std::ranges::all_of(head, [&first_row](std::int32_t& number) { return first_row.next(number); }) ||
        head[2] < 0) {
      return false;
    }
    const auto labels = static_cast<std::size_t>(head[2]);
    if (msh_element_type(head[1]).vertices == 0) {
      return false;
    }
    // Beside the vertices, whose number the type tells: the tag, the number of labels, and these.
    const PlainListShape shape{msh_element_type(head[1]).vertices, 2 + labels};
    Workers& workers = rows_.workers().workers;
    const auto make_room = [&](std::size_t vertices) {
      shared_resize(cells_.connectivity, vertices, cells_.offsets, element_count_ + 1, workers);
      shared_resize(cells_.types, element_count_, workers);
      shared_resize(elements_.physical, element_count_, elements_.geometrical, element_count_, workers);
      shared_resize(elements_.partition, element_count_, workers);
    };
    MshRowTags tags(MshTagKind::int32, element_count_);
    using PartTags = MshRowTags::Part<std::int32_t>;
    const auto read_row = [&](PlainNumbers& numbers, PartTags& part_tags, std::size_t row, std::size_t& item,
                              std::size_t last_item) {
      std::int32_t number = 0;
      std::size_t count = 0;
      if (!part_tags.next(numbers) || !numbers.next(number) || !numbers.next(count) || count != labels) {
        return false;
      }
      const MshElementType& type = msh_element_type(number);
      if (type.vertices == 0 || type.vertices > last_item - item || !next_labels(numbers, row, labels) ||
          !next_vertices<std::int32_t>(numbers, type, cells_.connectivity.data() + item)) {
        return false;
      }
      item += type.vertices;
      cells_.offsets[row + 1] = static_cast<std::int64_t>(item);
      cells_.types[row] = type.cell;
      return numbers.at_end_of_line();
    };
    const bool plain = tags.read(rows_, input_, elements_.tags, [&](auto /*type*/) {
      return rows_.read_lists(element_count_, shape, make_room, [&](PlainNumbers& numbers, const auto& part) {
        PartTags part_tags(tags, part.first);
        std::size_t item = part.first_item;
        bool read = true;
        for (std::size_t row = part.first; row < part.last && read; ++row) {
          read = read_row(numbers, part_tags, row, item, part.last_item);
        }
        return read && item == part.last_item;
      });
    });
    if (!plain) {
      cells_.connectivity.clear();
      cells_.offsets.resize(1);
      cells_.types.clear();
      elements_.physical.clear();
      elements_.geometrical.clear();
      elements_.partition.clear();
    }
    return plain;
  }

  /// From PlainNumbers or the input.
  template <class Numbers>
  bool next_labels(Numbers& numbers, std::size_t element, std::size_t count) {
    FirstLabels first{};
    for (std::size_t i = 0; i < count; ++i) {
      std::int32_t label = 0;
      if (!numbers.next_whole(label, "a tag of an element", -largest_msh_int, largest_msh_int)) {
        return false;
      }
      if (i < first.size()) {
        first[i] = label;
      }
    }
    set_labels(element, first, count);
    return true;
  }

  static bool is_triangle(const MshElementType& type) { return type.vertices == 3 && type.places.empty(); }

  /// Rows `first` to `last` - 1 of triangles whose nodes' tags count on, which are most: no branch depends on what they
  /// are. False where one refers to a node that there is not.
  template <class Tag, class Numbers, class BeginCell>
  static bool next_triangles(Numbers& numbers, MshRowTags& tags, const MshTags::Run& nodes, std::size_t first,
                             std::size_t last, const BeginCell& begin_cell) {
    MshRowTags::Part<Tag> part_tags(tags, first);
    std::uint64_t outside = 0;  // below 2^63 where nobody is
    for (std::size_t row = first; row < last; ++row) {
      std::array<Tag, 3> triangle{};
      if (!part_tags.next(numbers) || !next_tags(numbers, triangle)) {
        return false;
      }
      std::int32_t* const vertices = begin_cell(row);
      for (std::size_t i = 0; i < triangle.size(); ++i) {
        const std::uint64_t vertex = static_cast<std::uint64_t>(triangle[i]) - static_cast<std::uint64_t>(nodes.first);
        outside |= vertex | (nodes.count - 1 - vertex);
        vertices[i] = static_cast<std::int32_t>(vertex);
      }
    }
    return outside >> 63 == 0;
  }

  /// The vertices that the next tags of nodes stand for, of PlainNumbers, BinaryNumbers or the input; false where one
  /// cannot be read, or is of no node.
  template <class Tag, class Numbers>
  bool next_vertices(Numbers& numbers, const MshElementType& type, std::int32_t* vertices) {
    if constexpr (!std::is_same_v<Numbers, MshInput>) {
      if (is_triangle(type)) {
        // Triangles, and so most of the numbers of most files.
        std::array<Tag, 3> tags{};
        bool found = next_tags(numbers, tags);
        for (std::size_t i = 0; i < tags.size() && found; ++i) {
          const std::int64_t vertex = nodes_.find(static_cast<std::int64_t>(tags[i]));
          found = vertex >= 0;
          vertices[i] = static_cast<std::int32_t>(vertex);
        }
        return found;
      }
    }
    for (std::size_t i = 0; i < type.vertices; ++i) {
      std::int64_t tag = 0;
      if constexpr (std::is_same_v<Numbers, MshInput>) {
        tag = next_element_or_node_tag("the tag of a node");
      } else if (!next_tag<Tag>(numbers, tag)) {
        return false;
      }
      const std::int64_t vertex = nodes_.find(tag);
      if (vertex < 0) {
        return numbers.fail([tag](std::string_view /*token*/) {
          return "the element refers to node " + std::to_string(tag) + ", which the file does not have";
        });
      }
      vertices[type.places.empty() ? i : type.places[i]] = static_cast<std::int32_t>(vertex);
    }
    return true;
  }

  void read_binary_group() {
    const MshElementType& type = next_type();
    const std::int64_t count = input_.integer("the number of elements of a group", 0, largest_msh_int);
    const std::int64_t labels = input_.integer("the number of tags of an element", 0, largest_msh_int);
    if (static_cast<std::size_t>(count) > element_count_ - cells_.size()) {
      fail_count(std::to_string(cells_.size() + static_cast<std::size_t>(count)) + " or more");
    }
    for (std::int64_t i = 0; i < count; ++i) {
      tag_list_.push_back(input_.integer("the tag of an element", 0, largest_msh_int));
      read_labels(static_cast<std::size_t>(labels));
      read_vertices(type);
    }
  }

  void finish() {
    if (const auto twice = elements_.tags.finish()) {
      input_.fail_at(count_offset_, "the tag of element number " + std::to_string(*twice + 1) + " of " +
                                        std::to_string(element_count_) + " is that of another one before it");
    }
  }

  void finish_list() {
    finish();
    merge_repeated_elements(cells_, elements_);
  }

  MshInput& input_;
  MshRows& rows_;
  const MshTags& nodes_;
  MshEntities& entities_;
  CellList& cells_;
  MshElements& elements_;
  MemberBudget budget_;  ///< of groups beside the first
  std::size_t element_count_ = 0;
  std::size_t count_offset_ = 0;
  std::int64_t type_number_ = 0;
  std::vector<std::int64_t> tag_list_;
};

}  // namespace

void read_msh_elements(MshInput& input, MshRows& rows, const MshTags& nodes, MshEntities& entities,
                       MeshDocument& document, MshElements& elements) {
  MshElementReader reader(input, rows, nodes, entities, document, elements);
  if (input.header().version >= 40) {
    reader.read_blocks();
  } else if (input.header().version >= 20) {
    reader.read_list();
  } else {
    reader.read_list_of_version_1();
  }
}

}  // namespace trismooth
