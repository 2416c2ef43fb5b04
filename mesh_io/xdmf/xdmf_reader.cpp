// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/xdmf/xdmf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trismooth/base/text/counted.h"
#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/annotation_names.h"
#include "trismooth/mesh_io/document/array_limits.h"
#include "trismooth/mesh_io/document/integer_array.h"
#include "trismooth/mesh_io/document/last_step.h"
#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/text/text_scanner.h"
#include "trismooth/mesh_io/xdmf/xdmf_arrays.h"
#include "trismooth/mesh_io/xdmf/xdmf_cell_index.h"
#include "trismooth/mesh_io/xdmf/xdmf_grids.h"
#include "trismooth/mesh_io/xdmf/xdmf_items.h"
#include "trismooth/mesh_io/xdmf/xdmf_names.h"
#include "trismooth/mesh_io/xdmf/xdmf_original.h"
#include "trismooth/mesh_io/xdmf/xdmf_topology.h"
#include "trismooth/mesh_io/xml/xml_tree.h"

namespace trismooth {

namespace {

/// Points that grids share.
struct Block {
  std::size_t first = 0;
  std::size_t count = 0;
  std::optional<std::size_t> first_part{};  ///< of its cells
  CellIndex index{};                        ///< of all of them, where there are several parts
  bool is_indexed = false;
};

/// Cells that grids share: those of the document that each is.
struct Part {
  std::size_t number = 0;
  std::size_t block = 0;
  std::size_t count = 0;
  std::size_t first = 0;
  std::vector<std::int32_t> cells;  ///< empty: those from `first` on

  std::int32_t cell(std::size_t i) const { return cells.empty() ? static_cast<std::int32_t>(first + i) : cells[i]; }
};

/// A <DataItem> of a geometry.
struct GeometryItem {
  XdmfItem item;
  std::vector<std::uint64_t> offsets{};  ///< in the text, of each number
  std::vector<SiteColumn> columns{};
};
using GeometryItems = std::vector<GeometryItem>;

class XdmfReader {
 public:
  XdmfReader(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers)
      : path_(path),
        bytes_(std::move(bytes)),
        head_(parse_xml_head(path, bytes_, {}, {"Information"}, XmlDocumentType::without_entities)),
        paths_(path, head_.root),
        items_(path, bytes_, workers, paths_) {
    if (head_.root.name != "Xdmf") {
      throw ReadError(path, head_.root.line, "expected <Xdmf>, got <" + head_.root.name + ">");
    }
  }

  MeshDocument read() {
    const XdmfGrids grids = find_xdmf_grids(path_, head_.root, paths_);
    for (const XdmfGrid& grid : grids.first) {
      add_grid(grid);
    }
    std::vector<std::vector<const XdmfGrid*>> steps(grids.first.size());
    for (const auto& [first, later] : grids.later) {
      require_same(grids.first[first], later);
      steps[first].push_back(&later);
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      steps[i].insert(steps[i].begin(), &grids.first[i]);
      add_attributes(steps[i]);
    }
    finish(grids);
    return std::move(document_);
  }

 private:
  // --- geometry

  GeometryItems items_of(const XmlElement& geometry) {
    const std::string type = xdmf_word(xdmf_attribute(geometry, "GeometryType", "Type"));
    const bool is_split = type == "X_Y" || type == "X_Y_Z";
    const bool is_flat = type == "XY" || type == "X_Y";
    if (!is_split && !is_flat && type != "XYZ" && !type.empty()) {
      items_.fail(geometry.line,
                  "the geometry " + quoted(std::string_view(type)) + " is not read: XYZ, XY, X_Y_Z and X_Y are");
    }
    const std::size_t axes = is_flat ? 2 : 3;
    GeometryItems found;
    for (const XmlElement& child : geometry.children) {
      if (child.name == "DataItem") {
        found.push_back({.item = items_.find(child)});
      }
    }
    if (found.size() != (is_split ? axes : 1)) {
      items_.fail(geometry.line, "<Geometry> has " + std::to_string(found.size()) + " <DataItem>s where " +
                                     std::to_string(is_split ? axes : 1) + " are expected");
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t axis = 0; axis < axes; ++axis) {
        if (!is_split || axis == i) {
          found[i].columns.push_back({.component = static_cast<std::uint8_t>(axis)});
        }
      }
      const XdmfItem& item = found[i].item;
      if (item.type != ScalarType::float32 && item.type != ScalarType::float64) {
        items_.fail(item.line, "coordinates are expected to be numbers of floating point with 4 or 8 bytes");
      }
      if (item.count() % found[i].columns.size() != 0 ||
          item.count() / found[i].columns.size() != found[0].item.count() / found[0].columns.size()) {
        items_.fail(item.line, std::to_string(item.count()) + " coordinates are not those of whole points");
      }
    }
    return found;
  }

  static std::string key_of(const GeometryItems& items) {
    std::string key;
    for (const GeometryItem& one : items) {
      key.append(one.item.key).append(" ").append(std::to_string(one.columns.size())).append(" ");
    }
    return key;
  }

  std::vector<double> values_of(GeometryItem& one) {
    std::vector<double> values = one.item.place == XdmfItem::Place::text
                                     ? items_.read_coordinates(one.item, one.offsets)
                                     : items_.read<double>(one.item);
    const auto wrong = std::ranges::find_if(values, [](double value) { return !std::isfinite(value); });
    if (wrong != values.end()) {
      items_.fail(one.item.line, "the coordinate " + std::to_string(wrong - values.begin() + 1) + " is not finite");
    }
    return values;
  }

  void keep(GeometryItem one, std::size_t first_point) {
    (one.item.type == ScalarType::float32 ? has_float32_ : has_float64_) = true;
    items_.keep_coordinates(one.item, std::move(one.offsets), std::move(one.columns), first_point);
  }

  std::size_t block_of(const XmlElement& geometry) {
    if (const auto known = block_of_element_.find(&geometry); known != block_of_element_.end()) {
      return known->second;
    }
    GeometryItems items = items_of(geometry);
    const auto [place, is_new] = block_of_key_.emplace(key_of(items), blocks_.size());
    block_of_element_.emplace(&geometry, place->second);
    if (!is_new) {
      return place->second;
    }
    Block block{.first = document_.point_count()};
    block.count = static_cast<std::size_t>(items[0].item.count() / items[0].columns.size());
    for (GeometryItem& one : items) {
      const std::vector<double> values = values_of(one);
      if (block.count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) - block.first) {
        throw ReadError(path_, "has more points than are read");
      }
      document_.points.resize(3 * (block.first + block.count));
      const std::size_t columns = one.columns.size();
      for (std::size_t i = 0; i < block.count; ++i) {
        for (std::size_t c = 0; c < columns; ++c) {
          document_.points[3 * (block.first + i) + one.columns[c].component] = values[columns * i + c];
        }
      }
      keep(std::move(one), block.first);
    }
    blocks_.push_back(block);
    return place->second;
  }

  // --- topology

  std::string key_of(const XmlElement& topology, std::size_t block) {
    std::string key = std::to_string(block) + " " + xdmf_word(xdmf_attribute(topology, "TopologyType", "Type")) + " " +
                      xdmf_attribute(topology, "NodesPerElement") + " " + xdmf_attribute(topology, "BaseOffset");
    if (const XmlElement* const item = topology.child("DataItem")) {
      key.append(" ").append(items_.find(*item).key);
    }
    return key;
  }

  const Part& part_of(const XmlElement& topology, std::size_t block_number) {
    const std::pair element(&topology, block_number);
    if (const auto known = part_of_element_.find(element); known != part_of_element_.end()) {
      return parts_[known->second];
    }
    const auto [place, is_new] = part_of_key_.emplace(key_of(topology, block_number), parts_.size());
    part_of_element_.emplace(element, place->second);
    if (is_new) {
      parts_.push_back(new_part(topology, block_number));
    }
    return parts_[place->second];
  }

  Part new_part(const XmlElement& topology, std::size_t block_number) {
    Block& block = blocks_[block_number];
    CellList read = read_xdmf_cells(items_, topology, block.count);
    CellList& cells = document_.cells;
    Part part{.number = parts_.size(), .block = block_number, .count = read.size(), .first = cells.size(), .cells = {}};
    if (read.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) - cells.size()) {
      throw ReadError(path_, "has more cells than are read");
    }
    for (std::int32_t& vertex : read.connectivity) {
      vertex += static_cast<std::int32_t>(block.first);
    }
    if (!block.first_part) {
      block.first_part = part.number;
      append(std::move(read));
    } else {
      match(read, block, part);
    }
    return part;
  }

  void append(CellList read) {
    CellList& cells = document_.cells;
    if (cells.size() == 0) {
      cells = std::move(read);
      return;
    }
    for (std::size_t i = 0; i < read.size(); ++i) {
      cells.append(read.types[i], read[i]);
    }
  }

  /// Cells that the block has already are these; others are added.
  void match(const CellList& read, Block& block, Part& part) {
    CellList& cells = document_.cells;
    const Part& first = parts_[*block.first_part];
    if (first.count > 0 && !block.is_indexed) {
      block.index.add(cells, first.first, first.first + first.count);
    }
    block.is_indexed = true;
    part.cells.resize(read.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      const auto found = block.index.find(read[i]);
      part.cells[i] = found.value_or(static_cast<std::int32_t>(cells.size()));
      if (!found) {
        cells.append(read.types[i], read[i]);
      }
    }
    block.index.add(cells, part.first, cells.size());
  }

  // --- what grids have besides

  void add_grid(const XdmfGrid& grid) {
    const std::size_t block = block_of(*grid.geometry);
    const Part& part = part_of(*grid.topology, block);
    for (const XmlElement* const set : grid.sets) {
      if (seen_.emplace(std::pair(set, part.number), true).second) {
        add_set(*set, part);
      }
    }
  }

  /// Those of the last step, and of steps before it what none behind them has: tags, say, that the first one has alone.
  void add_attributes(const std::vector<const XdmfGrid*>& steps) {
    const Part& part = part_of(*steps.front()->topology, block_of(*steps.front()->geometry));
    std::set<std::string> names;
    // NOLINTNEXTLINE(modernize-loop-convert): a reversed view is beyond Clang 14
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      std::set<std::string> own;
      for (const XmlElement* const attribute : (*step)->attributes) {
        const std::string name = name_of(*attribute);
        own.insert(name);
        if (!names.contains(name) && seen_.emplace(std::pair(attribute, part.number), true).second) {
          add_attribute(*attribute, part);
        }
      }
      names.merge(own);
    }
  }

  /// As it is: blanks are part of it. What has none is called as VTK files call it.
  static std::string name_of(const XmlElement& element) {
    const std::string* const name = element.attribute("Name");
    return name == nullptr || name->empty() ? "unnamed" : *name;
  }

  void add_attribute(const XmlElement& attribute, const Part& part) {
    const std::string name = name_of(attribute);
    if (is_annotation(name)) {
      document_.has_stale_annotations = true;
      return;
    }
    const std::string center = xdmf_word(xdmf_attribute(attribute, "Center"));
    const bool is_of_points = center.empty() || center == "NODE";
    const std::string kind = xdmf_word(xdmf_attribute(attribute, "ItemType"));
    const auto items = std::ranges::count(attribute.children, std::string_view("DataItem"), &XmlElement::name);
    if ((!is_of_points && center != "CELL" && center != "GRID") || items != 1 || !kind.empty()) {
      kept_alone_.push_back(name);
      return;
    }
    const XdmfItem item = items_.find(*attribute.child("DataItem"));
    const Block& block = blocks_[part.block];
    const std::size_t rows = center == "GRID" ? 1 : is_of_points ? block.count : part.count;
    if (rows > 0 && item.count() == 0) {
      items_.fail(attribute.line, "the array " + quoted(std::string_view(name)) + " has no numbers");
    }
    const std::uint64_t components = rows > 0 ? item.count() / rows : item.extents.size() > 1 ? item.extents.back() : 1;
    if (!item.type || item.count() != components * rows || components == 0 ||
        (rows == 0 && components > most_components_without_rows)) {
      kept_alone_.push_back(name);
      return;
    }
    DataArray array = items_.read_array(item, name, static_cast<std::size_t>(components));
    if (item.is_untyped && center == "CELL" && components == 1) {
      if (auto whole = whole_numbers(array)) {
        array = make_integer_array(name, std::move(*whole));
        guessed_.insert(name);
      }
    }
    if (center == "GRID") {
      document_.field_arrays.push_back(std::move(array));
    } else if (is_of_points) {
      point_arrays_.add(std::move(array), part.block, consecutive(block.first, block.count));
    } else {
      cell_arrays_.add(std::move(array), part.number,
                       part.cells.empty() ? consecutive(part.first, part.count) : part.cells);
    }
  }

  /// The numbers, where all are whole.
  static std::optional<std::vector<std::int64_t>> whole_numbers(const DataArray& array) {
    std::vector<std::int64_t> whole;
    for (std::size_t row = 0; row < array.rows(); ++row) {
      constexpr double most = 9007199254740992.0;  // 2^53
      const double value = array.value(row);
      if (!(std::abs(value) <= most) || value != std::floor(value)) {
        return std::nullopt;
      }
      whole.push_back(static_cast<std::int64_t>(value));
    }
    return whole;
  }

  /// Empty where they begin at 0.
  static std::vector<std::int32_t> consecutive(std::size_t first, std::size_t count) {
    std::vector<std::int32_t> rows(first == 0 ? 0 : count);
    std::iota(rows.begin(), rows.end(), static_cast<std::int32_t>(first));
    return rows;
  }

  void add_set(const XmlElement& set, const Part& part) {
    const std::string name = name_of(set);
    const std::string type = xdmf_word(xdmf_attribute(set, "SetType", "Type"));
    const auto items = std::ranges::count(set.children, std::string_view("DataItem"), &XmlElement::name);
    if ((type != "NODE" && type != "CELL") || items != 1) {
      kept_alone_.push_back(name);
      return;
    }
    const bool is_of_points = type == "NODE";
    const Block& block = blocks_[part.block];
    NamedSet named{.name = name, .members = {}};
    const std::size_t count = is_of_points ? block.count : part.count;
    for (const std::int64_t member : items_.read<std::int64_t>(items_.find(*set.child("DataItem")))) {
      if (member < 0 || static_cast<std::uint64_t>(member) >= count) {
        items_.fail(set.line, "the set " + quoted(std::string_view(name)) + " has the member " +
                                  std::to_string(member) + ", and there are " + std::to_string(count));
      }
      const auto at = static_cast<std::size_t>(member);
      named.members.push_back(is_of_points ? static_cast<std::int32_t>(block.first + at) : part.cell(at));
    }
    (is_of_points ? document_.point_sets : document_.cell_sets).push_back(std::move(named));
  }

  // --- later time steps

  void require_same(const XdmfGrid& first, const XdmfGrid& later) {
    const std::size_t block = block_of(*first.geometry);
    if (!block_of_element_.contains(later.geometry)) {
      GeometryItems items = items_of(*later.geometry);
      const auto known = block_of_key_.find(key_of(items));
      block_of_element_.emplace(later.geometry, known == block_of_key_.end() ? block : known->second);
      if (known == block_of_key_.end()) {
        require_same_points(*later.geometry, std::move(items), block);
      }
    }
    if (block_of_element_.at(later.geometry) != block) {
      fail_moving(*later.geometry);
    }
    const Part& part = part_of(*first.topology, block);
    const std::pair element(later.topology, block);
    if (!part_of_element_.contains(element)) {
      const auto [place, is_new] = part_of_key_.emplace(key_of(*later.topology, block), part.number);
      if (is_new) {
        require_same_cells(*later.topology, part);
      }
      part_of_element_.emplace(element, place->second);
    }
    if (part_of_element_.at(element) != part.number) {
      items_.fail(later.topology->line,
                  "a time step has other cells than the first one: write one step to a file of its own");
    }
  }

  [[noreturn]] void fail_moving(const XmlElement& geometry) const {
    items_.fail(
        geometry.line,
        "a time step has other points than the first one, a mesh that moves: write one step to a file of its own");
  }

  /// Numbers of a later step that say the same once more: they are written back with the others.
  void require_same_points(const XmlElement& geometry, GeometryItems items, std::size_t block_number) {
    const Block& block = blocks_[block_number];
    block_of_key_.emplace(key_of(items), block_number);
    for (GeometryItem& one : items) {
      const std::vector<double> values = values_of(one);
      const std::size_t columns = one.columns.size();
      bool same = values.size() == columns * block.count;
      for (std::size_t i = 0; same && i < values.size(); ++i) {
        same = document_.points[3 * (block.first + i / columns) + one.columns[i % columns].component] == values[i];
      }
      if (!same) {
        fail_moving(geometry);
      }
      keep(std::move(one), block.first);
    }
  }

  void require_same_cells(const XmlElement& topology, const Part& part) {
    const Block& block = blocks_[part.block];
    const CellList read = read_xdmf_cells(items_, topology, block.count);
    bool same = read.size() == part.count;
    for (std::size_t i = 0; same && i < read.size(); ++i) {
      const auto cell = static_cast<std::size_t>(part.cell(i));
      same = std::ranges::equal(read[i], document_.cells[cell], {}, [&block](std::int32_t vertex) {
        return vertex + static_cast<std::int32_t>(block.first);
      });
    }
    if (!same) {
      items_.fail(topology.line, "a time step has other cells than the first one: write one step to a file of its own");
    }
  }

  // --- the end

  void finish(const XdmfGrids& grids) {
    std::size_t bytes = bytes_.size();
    items_.find_file_names(head_.root);
    XdmfSource source{.path = path_,
                      .bytes = {},
                      .files = {},
                      .names = items_.file_names(),
                      .coordinates = items_.take_coordinates(),
                      .points = document_.point_count()};
    source.files = items_.take_files();
    for (const XdmfHeavyFile& file : source.files) {
      bytes += file.bytes ? file.bytes->size() : 0;
    }
    MemberBudget budget(path_, bytes);
    document_.point_arrays = point_arrays_.take(document_.point_count(), budget);
    document_.cell_arrays = cell_arrays_.take(document_.cells.size(), budget);
    for (const XdmfGrid& grid : grids.first) {
      for (const XmlElement* const information : grid.information) {
        add_xdmf_names(path_, information->text, document_);
      }
    }
    document_.point_type = has_float64_ || !has_float32_ ? ScalarType::float64 : ScalarType::float32;
    document_.has_float32_axis = has_float32_ && has_float64_;
    add_notes(grids);
    source.bytes = std::move(bytes_);
    document_.original = make_xdmf_original(std::move(source));
  }

  void add_notes(const XdmfGrids& grids) {
    std::vector<std::string>& notes = document_.notes;
    if (grids.domains > 1) {
      notes.push_back("the file has " + std::to_string(grids.domains) +
                      " domains, of which the first is read; the others stay as they are");
    }
    if (blocks_.size() > 1) {
      notes.push_back(
          "the file has " + std::to_string(blocks_.size()) +
          " grids with points of their own, which are read as one mesh: where they meet they are not joined");
    }
    if (grids.steps > 1) {
      notes.push_back(note_of_last_step("Values", grids.steps, grids.time, "XDMF"));
    }
    if (!guessed_.empty()) {
      constexpr std::size_t most = 8;
      notes.push_back(
          "Numbers of cells that are all whole and tell no NumberType are read as whole ones, as tags are: " +
          first_of_list(guessed_, most) + "; NumberType=\"Float\" in the file makes them real numbers.");
    }
    if (!kept_alone_.empty()) {
      std::string names;
      for (const std::string& name : kept_alone_) {
        names.append(names.empty() ? "" : ", ").append(name.empty() ? "(no name)" : name);
        if (names.size() > 200) {
          names += ", ...";
          break;
        }
      }
      notes.push_back(
          "only a file of the same format keeps what is neither of points nor of cells, or no array of numbers: " +
          names);
    }
  }

  std::filesystem::path path_;
  FileBytes bytes_;
  XmlHead head_;
  XdmfPaths paths_;
  XdmfItems items_;
  MeshDocument document_;
  std::vector<Block> blocks_;
  std::vector<Part> parts_;
  std::map<const XmlElement*, std::size_t> block_of_element_;
  std::map<std::string, std::size_t, std::less<>> block_of_key_;
  std::map<std::pair<const XmlElement*, std::size_t>, std::size_t> part_of_element_;
  std::map<std::string, std::size_t, std::less<>> part_of_key_;
  std::map<std::pair<const XmlElement*, std::size_t>, bool> seen_;  ///< attributes that several grids include
  bool has_float32_ = false;
  bool has_float64_ = false;
  XdmfArrays point_arrays_;
  XdmfArrays cell_arrays_;
  std::vector<std::string> kept_alone_;
  std::set<std::string> guessed_;  ///< arrays of whole numbers that the file does not call so
};

}  // namespace

MeshDocument read_xdmf(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& workers) {
  return XdmfReader(path, std::move(bytes), workers).read();
}

}  // namespace trismooth
