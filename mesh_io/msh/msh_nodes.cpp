// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/msh/msh_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "trismooth/mesh_io/msh/msh_row_tags.h"

namespace trismooth {

namespace {

constexpr std::size_t msh_real_bytes = sizeof(double);

/// That a list of their own is worth.
constexpr std::size_t least_even_nodes = 16;

/// The columns of a list of nodes with so many parameters.
std::vector<SiteColumn> site_columns(std::size_t parameters) {
  std::vector<SiteColumn> columns;
  for (std::size_t i = 0; i < 3 + parameters; ++i) {
    columns.push_back({.component = static_cast<std::uint8_t>(i)});
  }
  return columns;
}

class MshNodeReader {
 public:
  MshNodeReader(MshInput& input, MshRows& rows, MeshDocument& document, MshNodes& nodes)
      : input_(input), rows_(rows), document_(document), nodes_(nodes) {}

  void read_blocks() {
    const bool of_4_1 = input_.header().version >= 41;
    const std::int64_t blocks = input_.size("the number of blocks of nodes");
    begin(input_.size("the number of nodes", largest_msh_int));
    if (of_4_1) {
      // What tags there are is seen by the tags themselves.
      input_.size("the smallest tag of a node");
      input_.size("the largest tag of a node");
    }
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::int64_t first = input_.integer("a dimension or a tag of an entity", -largest_msh_int, largest_msh_int);
      const std::size_t first_offset = input_.number_offset();
      const std::int64_t second =
          input_.integer("a dimension or a tag of an entity", -largest_msh_int, largest_msh_int);
      const std::int64_t dimension = of_4_1 ? first : second;
      if (dimension < 0 || dimension > 3) {
        input_.fail_at(of_4_1 ? first_offset : input_.number_offset(),
                       "expected the dimension of an entity, 0 to 3, got " + std::to_string(dimension));
      }
      const bool parametric = input_.integer("0, or 1 for parametric nodes", 0, 1) == 1;
      MshParametricNodes block_nodes{.dimension = static_cast<int>(dimension),
                                     .entity = of_4_1 ? second : first,
                                     .parameters = static_cast<std::size_t>(parametric ? dimension : 0),
                                     .flag_offset = input_.number_offset()};
      const auto count = static_cast<std::size_t>(input_.size("the number of nodes of a block", largest_msh_int));
      if (count > node_count_ - done_) {
        fail_count(std::to_string(done_ + count) + " or more");
      }
      const std::size_t numbers = 4 + block_nodes.parameters;
      const std::size_t tag_bytes = of_4_1 ? input_.header().size_bytes : sizeof(std::int32_t);
      input_.require_room("nodes in a block", count, numbers, tag_bytes + (numbers - 1) * msh_real_bytes);
      note_entity(dimension, count);
      read_block(std::move(block_nodes), count, !of_4_1);
    }
    if (done_ != node_count_) {
      fail_count(std::to_string(done_));
    }
    finish();
  }

  /// Of versions 1 and 2: a list of all. Its length is text in binary files too.
  void read_list() {
    begin(input_.text().next_integer("the number of nodes", 0, largest_msh_int));
    if (input_.header().version < 20 && has_parameters()) {
      read_parametric_rows();
      return;
    }
    start_binary_data();
    input_.require_room("nodes", node_count_, 4, sizeof(std::int32_t) + 3 * msh_real_bytes);
    read_block({}, node_count_, true);
    finish();
  }

  /// $ParametricNodes of version 2: the entity of each node stands behind its coordinates, and its place there.
  void read_parametric_list() {
    begin(input_.text().next_integer("the number of nodes", 0, largest_msh_int));
    start_binary_data();
    read_parametric_rows();
  }

 private:
  /// In version 1, whose $NOD has such rows, too, where Gmsh saves parameters.
  bool has_parameters() {
    constexpr int plain_numbers = 4;
    const std::size_t begin = input_.offset();
    for (int number = 0; number < plain_numbers; ++number) {
      input_.text().next_token("a node");
    }
    const bool goes_on = !input_.text().at_end_of_line();
    input_.seek(begin);
    return goes_on;
  }

  void read_parametric_rows() {
    input_.require_room("nodes", node_count_, 6, 3 * sizeof(std::int32_t) + 3 * msh_real_bytes);
    document_.points.resize(3 * node_count_);
    for (; done_ < node_count_; ++done_) {
      tag_list_.push_back(input_.integer("the tag of a node", 0, largest_msh_int));
      std::array<std::uint64_t, 6> offsets{};
      for (std::size_t i = 0; i < 3; ++i) {
        document_.points[3 * done_ + i] = input_.real("a coordinate");
        offsets[i] = input_.number_offset();
      }
      const std::int64_t dimension = input_.integer("the dimension of an entity", -1, 3);
      note_entity(dimension, 1);
      const std::size_t flag_offset = input_.number_offset();
      const std::int64_t entity = input_.integer("the tag of an entity", -largest_msh_int, largest_msh_int);
      const auto parameters = static_cast<std::size_t>(dimension == 1 || dimension == 2 ? dimension : 0);
      MshNodeList& list = list_for({.dimension = static_cast<int>(dimension),
                                    .entity = entity,
                                    .parameters = parameters,
                                    .flag_offset = flag_offset});
      for (std::size_t i = 0; i < parameters; ++i) {
        list.parametric.values.push_back(input_.real("a parametric coordinate"));
        offsets[3 + i] = input_.number_offset();
      }
      list.sites.offsets.insert(list.sites.offsets.end(), offsets.begin(),
                                offsets.begin() + static_cast<std::ptrdiff_t>(3 + parameters));
    }
    nodes_.tags.add(tag_list_);
    finish();
  }

  /// The next `count` nodes are of an entity of that dimension; -1: of none.
  void note_entity(std::int64_t dimension, std::size_t count) {
    nodes_.any_on_surfaces = nodes_.any_on_surfaces || (dimension > 1 && count > 0);
    if (dimension == 0 || dimension == 1) {
      std::vector<std::int32_t>& vertices = dimension == 0 ? nodes_.on_points : nodes_.on_curves;
      for (std::size_t node = 0; node < count; ++node) {
        vertices.push_back(static_cast<std::int32_t>(done_ + node));
      }
    }
  }

  void begin(std::int64_t count) {
    node_count_ = static_cast<std::size_t>(count);
    count_offset_ = input_.number_offset();
    // Each takes more than its coordinates as text.
    input_.require_room("nodes", node_count_, 3, 3 * msh_real_bytes);
    shared_reserve(document_.points, 3 * node_count_, rows_.workers().workers);
  }

  [[noreturn]] void fail_count(const std::string& got) const {
    input_.fail_at(count_offset_, "expected " + std::to_string(node_count_) + " nodes in all blocks, got " + got);
  }

  void start_binary_data() {
    if (input_.header().binary) {
      input_.text().next_line();
    }
  }

  /// Nodes without parameters go on in one list, those of one entity with them in another.
  MshNodeList& list_for(MshParametricNodes nodes) {
    const bool goes_on = !nodes_.lists.empty() && !nodes_.lists.back().sites.even &&
                         nodes_.lists.back().parametric.parameters == nodes.parameters &&
                         (nodes.parameters == 0 ||
                          (nodes_.lists.back().parametric.dimension == nodes.dimension &&
                           nodes_.lists.back().parametric.entity == nodes.entity && input_.header().version < 40));
    if (!goes_on) {
      MshNodeList& list = nodes_.lists.emplace_back();
      list.first_vertex = done_;
      list.sites.encoding = input_.header().encoding();
      list.sites.columns = site_columns(nodes.parameters);
      list.parametric = std::move(nodes);
    }
    return nodes_.lists.back();
  }

  void read_block(MshParametricNodes nodes, std::size_t count, bool tags_in_rows) {
    if (!tags_in_rows) {
      read_tags(count);
      if (nodes.parameters == 0 && count >= least_even_nodes && read_even_rows(count)) {
        done_ += count;
        return;
      }
    }
    MshNodeList& list = list_for(std::move(nodes));
    const std::size_t parameters = list.parametric.parameters;
    const std::size_t columns = 3 + parameters;
    const std::size_t first_site = list.sites.size();
    Workers& workers = rows_.workers().workers;
    if (parameters == 0 && first_site == 0 && nodes_.lists.size() == 1) {
      shared_reserve(list.sites.offsets, 3 * node_count_, workers);
    }
    grow_shared(document_.points, 3 * (done_ + count), list.sites.offsets, columns * (first_site + count), workers);
    list.parametric.values.resize(parameters * (first_site + count));
    const Block block{list, done_, first_site, count};
    if (!tags_in_rows) {
      if (!read_plain_rows(block, false)) {
        for (std::size_t node = 0; node < count; ++node) {
          read_row(input_, block, node);
        }
      }
    } else if (!read_plain_rows(block, true)) {
      tag_list_.clear();
      for (std::size_t node = 0; node < count; ++node) {
        tag_list_.push_back(input_.integer("the tag of a node", 0, largest_msh_int));
        read_row(input_, block, node);
      }
      nodes_.tags.add(tag_list_);
    }
    done_ += count;
  }

  /// Coordinates alone, of a binary file: a list of their own, whose sites need no memory. False where anything is
  /// unusual: nothing has changed then.
  bool read_even_rows(std::size_t count) {
    if (!input_.header().binary) {
      return false;
    }
    constexpr std::size_t row_bytes = 3 * msh_real_bytes;
    const EvenSites even{input_.offset(), row_bytes, count};
    document_.points.resize(3 * (done_ + count));
    const bool plain =
        rows_.read_binary({count, 3, row_bytes}, [&](auto& numbers, std::size_t first, std::size_t last) {
          const auto values = std::span(document_.points).subspan(3 * (done_ + first), 3 * (last - first));
          return numbers.next_all(values) && std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
        });
    if (plain) {
      MshNodeList& list = nodes_.lists.emplace_back();
      list.first_vertex = done_;
      list.sites.encoding = input_.header().encoding();
      list.sites.columns = site_columns(0);
      list.sites.even = even;
    }
    return plain;
  }

  /// Nodes of a list that are read now.
  struct Block {
    MshNodeList& list;
    std::size_t first_vertex;
    std::size_t first_site;
    std::size_t count;
  };

  /// The coordinates of a node and its parameters, from PlainNumbers, BinaryNumbers or the input.
  template <class Numbers>
  bool read_row(Numbers& numbers, const Block& block, std::size_t node) {
    const std::size_t columns = block.list.sites.columns.size();
    const std::size_t parameters = columns - 3;
    double* const point = document_.points.data() + 3 * (block.first_vertex + node);
    std::uint64_t* const offsets = block.list.sites.offsets.data() + columns * (block.first_site + node);
    bool read = true;
    for (std::size_t i = 0; i < 3; ++i) {
      read = read && numbers.next_real(point[i], "a coordinate");
      offsets[i] = numbers.token_offset();
    }
    for (std::size_t i = 0; i < parameters; ++i) {
      double& value = block.list.parametric.values[parameters * (block.first_site + node) + i];
      read = read && numbers.next_real(value, "a parametric coordinate");
      offsets[3 + i] = numbers.token_offset();
    }
    return read;
  }

  void read_tags(std::size_t count) {
    const MshTagKind kind = tag_kind_of(input_.header());
    if (MshRowTags(kind, count)
            .read(rows_, input_, {count, 1, tag_bytes(kind)}, nodes_.tags,
                  [](auto& /*numbers*/, std::size_t /*row*/, auto /*type*/) { return true; })) {
      return;
    }
    tag_list_.clear();
    for (std::size_t node = 0; node < count; ++node) {
      tag_list_.push_back(input_.size("the tag of a node"));
    }
    nodes_.tags.add(tag_list_);
  }

  bool read_plain_rows(const Block& block, bool tags_in_rows) {
    const std::size_t columns = block.list.sites.columns.size();
    if (tags_in_rows) {
      const MshTagKind kind = tag_kind_of(input_.header());
      return MshRowTags(kind, block.count)
          .read(rows_, input_, {block.count, 1 + columns, tag_bytes(kind) + columns * msh_real_bytes}, nodes_.tags,
                [&](auto& numbers, std::size_t row, auto /*type*/) { return read_row(numbers, block, row); });
    }
    return rows_.read({block.count, columns, columns * msh_real_bytes},
                      [&](auto& numbers, std::size_t first, std::size_t last) {
                        bool plain = true;
                        for (std::size_t row = first; row < last && plain; ++row) {
                          plain = read_row(numbers, block, row);
                        }
                        return plain;
                      });
  }

  void finish() {
    if (const auto twice = nodes_.tags.finish()) {
      std::size_t vertex = *twice;
      for (const MshNodeList& list : nodes_.lists) {
        if (vertex < list.size()) {
          input_.fail_at(list.sites.offset_of(vertex, 0), "the tag of this node, number " + std::to_string(*twice + 1) +
                                                              " of " + std::to_string(node_count_) +
                                                              ", is that of another one before it");
        }
        vertex -= list.size();
      }
    }
  }

  MshInput& input_;
  MshRows& rows_;
  MeshDocument& document_;
  MshNodes& nodes_;
  std::size_t node_count_ = 0;
  std::size_t count_offset_ = 0;
  std::size_t done_ = 0;
  std::vector<std::int64_t> tag_list_;
};

}  // namespace

void read_msh_nodes(MshInput& input, MshRows& rows, bool parametric, MeshDocument& document, MshNodes& nodes) {
  MshNodeReader reader(input, rows, document, nodes);
  if (input.header().version >= 40) {
    reader.read_blocks();
  } else if (parametric) {
    reader.read_parametric_list();
  } else {
    reader.read_list();
  }
}

}  // namespace trismooth
