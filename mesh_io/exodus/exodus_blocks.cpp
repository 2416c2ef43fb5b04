// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/exodus/exodus_blocks.h"

#include <algorithm>
#include <limits>
#include <set>
#include <span>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/letter_case.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/bytes/shared_blocks.h"
#include "trismooth/mesh_io/document/cells/uniform_cells.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/exodus/exodus_elements.h"
#include "trismooth/mesh_io/text/number_text.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr auto most_cells = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

class BlockReader {
 public:
  BlockReader(const NetcdfFile& file, std::size_t axes, const FileWorkers& workers, MeshDocument& document)
      : file_(file), axes_(axes), workers_(workers), document_(document) {}

  std::vector<ExodusBlock> read() {
    for (const auto& [number, connect] : numbered_variables(file_, "connect")) {
      ExodusBlock& block = blocks_.emplace_back();
      block.number = number;
      block.type = connect->text_of("elem_type");
      block.first_element = elements_;
      block.first_cell = document_.cells.size();
      read_block(*connect, block);
      elements_ += block.elements;
    }
    add_notes();
    return std::move(blocks_);
  }

 private:
  [[noreturn]] void fail(const ExodusBlock& block, const std::string& message) const {
    throw ReadError(file_.path(), "element block " + std::to_string(block.number) + " " + message);
  }

  void read_block(const NetcdfVariable& connect, ExodusBlock& block) {
    const std::string type = upper_case(block.type);
    if (type.starts_with("NFACED")) {
      block.elements = file_.length_of("num_el_in_blk" + std::to_string(block.number)).value_or(0);
      block.has_cells = false;
      if (block.elements > most_cells) {
        fail(block, "has more elements than 32-bit indices can tell apart");
      }
      ++blocks_of_faces_;
      return;
    }
    if (type.starts_with("NSIDED")) {
      read_polygons(connect, block);
      return;
    }
    if (connect.shape.size() != 2) {
      fail(block, "is no table of elements and their nodes");
    }
    block.elements = connect.shape[0];
    const std::size_t nodes = connect.shape[1];
    if (block.elements == 0) {
      return;
    }
    if (nodes == 0) {
      fail(block, "has elements without nodes");
    }
    require_cells(block);
    const ExodusShape& shape = exodus_shape(block.type, nodes, axes_);
    if (shape.nodes == 0) {
      unknown_.emplace(block.type, nodes);
    }
    CellList& cells = document_.cells;
    append_uniform_cells(cells, shape.nodes == 0 ? cell_type::poly_vertex : shape.type, nodes, block.elements,
                         workers_);
    std::int32_t* const first = cells.connectivity.data() + (cells.connectivity.size() - block.elements * nodes);
    if (connect.type == NetcdfType::int32 && shape.places == nullptr) {
      // Nearly all files: read in their place.
      const std::span<std::int32_t> references(first, block.elements * nodes);
      file_.read(connect, {}, references);
      fill_vertices(block, references, nodes, [first](std::size_t i) -> std::int32_t& { return first[i]; });
      return;
    }
    with_references(connect, [&](const auto& references) {
      if (shape.places == nullptr) {
        fill_vertices(block, references, nodes, [first](std::size_t i) -> std::int32_t& { return first[i]; });
      } else {
        fill_vertices(block, references, nodes, [first, &shape, nodes](std::size_t i) -> std::int32_t& {
          return first[i - i % nodes + shape.place(i % nodes)];
        });
      }
    });
  }

  template <class Function>
  void with_references(const NetcdfVariable& connect, const Function& function) {
    if (connect.type == NetcdfType::int32) {
      function(file_.values<std::int32_t>(connect));
    } else {
      function(file_.values<std::int64_t>(connect));
    }
  }

  /// Nodes are numbered from 1.
  template <class References, class Target>
  void fill_vertices(const ExodusBlock& block, const References& references, std::size_t nodes, const Target& target) {
    const auto points = document_.point_count();
    const std::size_t wrong = first_wrong(workers_, references.size(), sizeof(references.front()), [&](std::size_t i) {
      // Unsigned: 0 and negative numbers are too large.
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(references[i])) - 1 >= points;
    });
    if (wrong < references.size()) {
      fail(block, "names node " + std::to_string(references[wrong]) + ", of " + std::to_string(points) +
                      (nodes > 0 ? ", in its element " + std::to_string(wrong / nodes + 1) : ""));
    }
    for_file_blocks(workers_, references.size(), sizeof(references.front()), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        target(i) = static_cast<std::int32_t>(references[i] - 1);
      }
    });
  }

  void read_polygons(const NetcdfVariable& connect, ExodusBlock& block) {
    const NetcdfVariable* const counts = file_.find("ebepecnt" + std::to_string(block.number));
    if (counts == nullptr || counts->shape.size() != 1 || connect.shape.size() != 1) {
      fail(block, "of polygons does not say how many nodes each has (ebepecnt)");
    }
    const std::vector<std::int64_t> of_each = file_.values<std::int64_t>(*counts);
    block.elements = of_each.size();
    require_cells(block);
    CellList& cells = document_.cells;
    std::uint64_t left = connect.shape.front();
    for (const std::int64_t nodes : of_each) {
      constexpr std::int64_t least = 3;
      if (nodes < least || static_cast<std::uint64_t>(nodes) > left) {
        fail(block, "has a polygon of " + std::to_string(nodes) + " nodes");
      }
      left -= static_cast<std::uint64_t>(nodes);
      cells.types.push_back(cell_type::of_face(static_cast<std::size_t>(nodes)));
      cells.offsets.push_back(cells.offsets.back() + nodes);
    }
    if (left != 0) {
      fail(block, "has nodes that are of no polygon");
    }
    with_references(connect, [&](const auto& references) {
      const std::size_t before = cells.connectivity.size();
      cells.connectivity.resize(before + references.size());
      fill_vertices(block, references, 0,
                    [&](std::size_t i) -> std::int32_t& { return cells.connectivity[before + i]; });
    });
  }

  void require_cells(const ExodusBlock& block) const {
    if (block.elements > most_cells - document_.cells.size()) {
      fail(block, "has more elements than 32-bit indices can tell apart");
    }
  }

  void add_notes() {
    if (!unknown_.empty()) {
      constexpr std::size_t most = 5;
      document_.notes.push_back("Elements of types that are not known hold their nodes: " +
                                first_of_list(unknown_, most,
                                              [](const std::pair<std::string, std::size_t>& type) {
                                                return trismooth::quoted(type.first) + " with " +
                                                       counted(type.second, "node", "nodes");
                                              }) +
                                ".");
    }
    if (blocks_of_faces_ > 0) {
      document_.notes.push_back(
          "Element blocks of polyhedra are kept in Exodus output only: " + std::to_string(blocks_of_faces_) + ".");
    }
  }

  const NetcdfFile& file_;
  std::size_t axes_;
  const FileWorkers& workers_;
  MeshDocument& document_;
  std::vector<ExodusBlock> blocks_;
  std::size_t elements_ = 0;
  std::set<std::pair<std::string, std::size_t>> unknown_;  ///< types and numbers of nodes
  std::size_t blocks_of_faces_ = 0;
};

}  // namespace

std::vector<std::pair<std::size_t, const NetcdfVariable*>> numbered_variables(const NetcdfFile& file,
                                                                              std::string_view name) {
  std::vector<std::pair<std::size_t, const NetcdfVariable*>> found;
  for (const NetcdfVariable& variable : file.content().variables) {
    if (variable.name.starts_with(name)) {
      const auto number = parse_integer(std::string_view(variable.name).substr(name.size()));
      if (number && *number > 0) {
        found.emplace_back(static_cast<std::size_t>(*number), &variable);
      }
    }
  }
  std::ranges::sort(found);  // of one number in the order of the file
  return found;
}

ExodusNames::ExodusNames(const NetcdfFile& file, std::string_view ids, std::string_view names) {
  if (const NetcdfVariable* const variable = file.find(ids); variable != nullptr) {
    ids_ = file.values<std::int64_t>(*variable);
  }
  if (const NetcdfVariable* const variable = file.find(names); variable != nullptr) {
    names_ = file.texts(*variable);
  }
}

std::vector<std::size_t> ExodusNames::without(const NetcdfFile& file, const std::string& variable) const {
  std::vector<std::size_t> numbers;
  for (std::size_t number = 1; number <= std::max(ids_.size(), names_.size()); ++number) {
    if (file.find(variable + std::to_string(number)) == nullptr) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

std::int64_t ExodusNames::id(std::size_t number) const {
  return number <= ids_.size() ? ids_[number - 1] : static_cast<std::int64_t>(number);
}

std::string ExodusNames::name(std::size_t number) const {
  return number <= names_.size() ? names_[number - 1] : std::string();
}

std::string ExodusNames::name_or(std::size_t number, std::string_view what) const {
  const std::string own = name(number);
  return own.empty() ? std::string(what) + " " + std::to_string(id(number)) : own;
}

std::vector<ExodusBlock> add_exodus_blocks(const NetcdfFile& file, std::size_t axes, const FileWorkers& workers,
                                           MeshDocument& document) {
  return BlockReader(file, axes, workers, document).read();
}

}  // namespace trismooth
