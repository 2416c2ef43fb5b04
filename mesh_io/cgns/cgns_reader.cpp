// SPDX-License-Identifier: BSD-3-Clause
// CGNS as the SIDS and the mapping to HDF5 describe it: a base has zones, a
// zone its coordinates, sections of elements, boundary conditions, solutions.
#include "trismooth/mesh_io/cgns/cgns_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "trismooth/base/text/list_text.h"
#include "trismooth/mesh_io/cgns/cgns_section_groups.h"
#include "trismooth/mesh_io/cgns/cgns_sections.h"
#include "trismooth/mesh_io/cgns/cgns_solutions.h"
#include "trismooth/mesh_io/cgns/cgns_tree.h"
#include "trismooth/mesh_io/document/cells/listed_groups.h"
#include "trismooth/mesh_io/errors.h"
#include "trismooth/mesh_io/hdf5/hdf5_original.h"
#include "trismooth/mesh_io/text/text_scanner.h"

namespace trismooth {

namespace {

constexpr std::string_view link_set_name = "cgns:connectivity";

/// Groups by name, in the order in which they come first.
class NamedMembers {
 public:
  std::vector<std::int32_t>& of(const std::string& name) {
    const auto [place, is_new] = places_.try_emplace(name, sets_.size());
    if (is_new) {
      sets_.push_back({name, {}});
    }
    return sets_[place->second].members;
  }

  bool has(const std::string& name) const { return places_.contains(name); }

  /// Each member once, ascending.
  std::vector<NamedSet> take() {
    for (NamedSet& set : sets_) {
      std::ranges::sort(set.members);
      set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
    }
    return std::move(sets_);
  }

 private:
  std::map<std::string, std::size_t> places_;
  std::vector<NamedSet> sets_;
};

class CgnsReader {
 public:
  CgnsReader(const std::filesystem::path& path, std::string_view bytes) : tree_(path, bytes) {}

  std::pair<MeshDocument, std::vector<Hdf5Column>> read() {
    choose_base();
    read_families();
    std::vector<CgnsNode> zones = tree_.children(base_.path, "Zone_t");
    if (zones.empty()) {
      tree_.fail_at(base_, "has no zones");
    }
    for (CgnsNode& zone : zones) {
      read_zone(std::move(zone));
    }
    // Conditions name points of other zones.
    for (const CgnsZone& zone : zones_) {
      read_conditions(zone);
      read_connectivity(zone);
    }
    add_empty_families();
    finish_sets();
    CgnsSolutions solutions = read_cgns_solutions(tree_, zones_, cell_dimension_, document_);
    document_.point_arrays = std::move(solutions.point_arrays);
    std::ranges::move(solutions.cell_arrays, std::back_inserter(document_.cell_arrays));
    std::ranges::move(solutions.columns, std::back_inserter(columns_));
    std::ranges::move(solutions.notes, std::back_inserter(document_.notes));
    return {std::move(document_), std::move(columns_)};
  }

 private:
  void choose_base() {
    std::vector<CgnsNode> bases = tree_.children("", "CGNSBase_t");
    if (bases.empty()) {
      tree_.fail("has no base (CGNSBase_t), and is no CGNS file");
    }
    base_ = bases.front();
    if (bases.size() > 1) {
      bases.erase(bases.begin());
      document_.notes.push_back("The file has several bases: " + base_.name +
                                " is read, the others are kept in CGNS output only (" +
                                list_text(bases, &CgnsNode::name) + ").");
    }
    const std::vector<std::int64_t> dimensions = tree_.integers(base_);
    if (dimensions.size() != 2 || dimensions[0] < 1 || dimensions[0] > 3 || dimensions[1] < 2 || dimensions[1] > 3) {
      tree_.fail_at(base_, "has no dimensions of cells and space that are read");
    }
    cell_dimension_ = static_cast<int>(dimensions[0]);
    axes_ = static_cast<std::size_t>(dimensions[1]);
  }

  /// Families may have names of their own: Gmsh's physical groups.
  void read_families() {
    for (const CgnsNode& family : tree_.children(base_.path, "Family_t")) {
      std::vector<std::string>& names = families_[family.name];
      for (const CgnsNode& name : tree_.children(family.path, "FamilyName_t")) {
        names.push_back(tree_.text(name));
      }
      if (names.empty()) {
        names.push_back(family.name);
      }
    }
  }

  /// The groups that a condition with these children makes.
  std::vector<std::string> group_names(const CgnsNode& node, const std::vector<CgnsNode>& children) {
    for (const CgnsNode& family : children) {
      if (std::string name = family.label == "FamilyName_t" ? tree_.text(family) : std::string(); !name.empty()) {
        const auto known = families_.find(name);
        used_families_.insert(name);
        return known == families_.end() ? std::vector<std::string>{std::move(name)} : known->second;
      }
    }
    return {node.name};
  }

  /// Those that neither a condition nor a zone is of.
  void add_empty_families() {
    for (const CgnsZone& zone : zones_) {
      group_names(zone.node, tree_.children(zone.node.path, "FamilyName_t"));
    }
    for (const auto& [family, names] : families_) {
      for (const std::string& name : names) {
        if (!used_families_.contains(family) && !of_points_.has(name)) {
          of_cells_.of(name);
        }
      }
    }
  }

  void read_zone(CgnsNode node) {
    const std::vector<CgnsNode> types = tree_.children(node.path, "ZoneType_t");
    const std::string type = types.empty() ? "Structured" : tree_.text(types.front());
    if (type != "Unstructured") {
      tree_.fail_at(node,
                    "is a structured zone, which is not read: write it "
                    "as an unstructured one");
    }
    const std::vector<std::int64_t> sizes = tree_.integers(node);
    if (sizes.size() < 2 || sizes[0] < 0) {
      tree_.fail_at(node, "has no numbers of vertices and cells");
    }
    CgnsZone zone{std::move(node), document_.point_count(), static_cast<std::size_t>(sizes[0]), {}};
    read_coordinates(zone);
    zone.sections = read_cgns_sections(tree_, zone.node, zone.first_point, zone.points, document_.cells);
    zones_.push_back(std::move(zone));
  }

  void read_coordinates(const CgnsZone& zone) {
    const std::vector<CgnsNode> grids = tree_.children(zone.node.path, "GridCoordinates_t");
    if (grids.empty()) {
      tree_.fail_at(zone.node, "has no coordinates (GridCoordinates_t)");
    }
    if (grids.size() > 1) {
      tree_.fail_at(zone.node,
                    "has several grids, for a mesh that moves in "
                    "time, which is not read");
    }
    if (zone.points + zone.first_point > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      tree_.fail("has more vertices than 32-bit indices can tell apart");
    }
    constexpr std::array<std::string_view, 3> names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      const auto node = tree_.child(grids.front(), names.at(axis), "DataArray_t");
      const std::string data = node ? tree_.data_of(*node) : std::string();
      if (data.empty()) {
        tree_.fail_at(grids.front(), "has no " + std::string(names.at(axis)) +
                                         "; coordinates are read that are "
                                         "rectangular, one for each axis");
      }
      read_axis(zone, *node, data, axis);
    }
  }

  void read_axis(const CgnsZone& zone, const CgnsNode& node, const std::string& data, std::size_t axis) {
    const Hdf5Shape shape = tree_.file().shape_of(data);
    if (shape.type != ScalarType::float32 && shape.type != ScalarType::float64) {
      tree_.fail_at(node, "holds no numbers of 32 or 64 bits with a fraction");
    }
    if (shape.count() != zone.points) {
      tree_.fail_at(node, "has " + std::to_string(shape.count()) + " numbers, expected one for each of the zone's " +
                              std::to_string(zone.points) + " vertices");
    }
    tree_.spend(shape.count());
    const std::vector<double> values = tree_.file().read<double>(data);
    // The number of vertices is known to be that of numbers now.
    document_.points.resize(3 * (zone.first_point + zone.points));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        tree_.fail_at(node, "has a number that is not finite at vertex " + std::to_string(i + 1));
      }
      document_.points[3 * (zone.first_point + i) + axis] = values[i];
    }
    (shape.type == ScalarType::float32 ? has_float32_ : has_float64_) = true;
    document_.point_type = has_float64_ ? ScalarType::float64 : ScalarType::float32;
    document_.has_float32_axis = has_float32_ && has_float64_;
    columns_.push_back(hdf5_column(tree_.file(), data, 0, zone.points, {{.component = static_cast<std::uint8_t>(axis)}},
                                   zone.first_point));
  }

  /// "Vertex" where a node with these children does not say where its members are.
  std::string location_of(const std::vector<CgnsNode>& children) {
    const auto node = std::ranges::find(children, "GridLocation_t", &CgnsNode::label);
    const std::string location = node == children.end() ? std::string() : tree_.text(*node);
    return location.empty() ? "Vertex" : location;
  }

  /// The numbers, from 1, that a list or a range of the node names: of vertices
  /// or of elements.
  struct Members {
    std::vector<std::int64_t> numbers = {};
    bool is_range = false;  ///< from the first number to the second
    bool of_elements = false;
  };

  Members members_of(const std::vector<CgnsNode>& children) {
    for (const CgnsNode& child : children) {
      const bool is_range = child.label == "IndexRange_t";
      if (!is_range && child.label != "IndexArray_t") {
        continue;
      }
      const bool of_elements = child.name.starts_with("Element");
      if (!of_elements && child.name != "PointList" && child.name != "PointRange") {
        continue;
      }
      Members members{tree_.integers(child), is_range, of_elements || location_of(children) != "Vertex"};
      if (is_range && (members.numbers.size() != 2 || members.numbers[0] > members.numbers[1])) {
        tree_.fail_at(child, "is no range: expected a first and a last number");
      }
      return members;
    }
    return {};
  }

  /// Calls add(place) of every vertex or element that is named.
  template <class Add>
  void for_each(const CgnsNode& node, const CgnsZone& zone, const Members& members, const Add& add) {
    const std::int64_t last =
        members.of_elements ? zone.sections.last_number() : static_cast<std::int64_t>(zone.points);
    const auto require = [&](std::int64_t number) {
      if (number < 1 || number > last) {
        tree_.fail_at(node, "names " + std::string(members.of_elements ? "element " : "vertex ") +
                                std::to_string(number) + ", which is none of its zone");
      }
    };
    const auto add_number = [&](std::int64_t number) {
      if (!members.of_elements) {
        add(static_cast<std::int32_t>(zone.first_point + static_cast<std::size_t>(number - 1)));
      } else if (const auto cell = zone.sections.find(number)) {
        add(*cell);
      }
    };
    std::ranges::for_each(members.numbers, require);
    if (members.is_range) {
      tree_.spend(static_cast<std::uint64_t>(members.numbers[1] - members.numbers[0]));
      for (std::int64_t number = members.numbers[0]; number <= members.numbers[1]; ++number) {
        add_number(number);
      }
    } else {
      std::ranges::for_each(members.numbers, add_number);
    }
  }

  void read_conditions(const CgnsZone& zone) {
    for (const CgnsNode& all : tree_.children(zone.node.path, "ZoneBC_t")) {
      for (const CgnsNode& condition : tree_.children(all.path, "BC_t")) {
        const std::vector<CgnsNode> children = tree_.children(condition.path, "");
        const Members members = members_of(children);
        for (const std::string& name : group_names(condition, children)) {
          std::vector<std::int32_t>& group = (members.of_elements ? of_cells_ : of_points_).of(name);
          tree_.spend(members.numbers.size());
          for_each(condition, zone, members, [&group](std::int32_t place) { group.push_back(place); });
        }
      }
    }
  }

  /// Vertices that are those of another zone, or of the other side of a period.
  void read_connectivity(const CgnsZone& zone) {
    for (const CgnsNode& all : tree_.children(zone.node.path, "ZoneGridConnectivity_t")) {
      for (const CgnsNode& link : tree_.children(all.path, "GridConnectivity_t")) {
        const std::vector<CgnsNode> children = tree_.children(link.path, "");
        const Members own = members_of(children);
        if (own.of_elements) {
          continue;
        }
        std::vector<std::int32_t> places;
        for_each(link, zone, own, [&places](std::int32_t place) { places.push_back(place); });
        linked_.insert(linked_.end(), places.begin(), places.end());
        const std::string other_name = tree_.text(link);
        const auto other = std::ranges::find(zones_, other_name, [](const CgnsZone& z) { return z.node.name; });
        const auto donors = std::ranges::find(children, "PointListDonor", &CgnsNode::name);
        if (other == zones_.end() || donors == children.end()) {
          continue;
        }
        const std::vector<std::int64_t> numbers = tree_.integers(*donors);
        if (numbers.size() != places.size()) {
          continue;
        }
        for (std::size_t i = 0; i < numbers.size(); ++i) {
          if (numbers[i] < 1 || numbers[i] > static_cast<std::int64_t>(other->points)) {
            tree_.fail_at(*donors, "names vertex " + std::to_string(numbers[i]) + ", which is none of its zone");
          }
          const auto donor = static_cast<std::int32_t>(other->first_point + static_cast<std::size_t>(numbers[i] - 1));
          document_.periodic_pairs.push_back({places[i], donor});
        }
      }
    }
  }

  void finish_sets() {
    document_.point_sets = of_points_.take();
    std::vector<NamedSet> groups = of_cells_.take();
    const bool has_groups = !std::ranges::all_of(groups, [](const NamedSet& group) { return group.members.empty(); });
    bool tells_sections = false;
    if (zones_.size() > 1) {
      document_.notes.emplace_back(
          "The file has several zones, which are joined: "
          "each is a group, and vertices that they "
          "have in common are those of each of them.");
      NamedMembers of_zones;
      for (const CgnsZone& zone : zones_) {
        std::vector<std::int32_t>& group = of_zones.of(zone.node.name);
        for (const CgnsSection& section : zone.sections.all()) {
          for (std::size_t i = 0; i < section.count; ++i) {
            const auto cell = static_cast<std::int32_t>(section.first_cell + i);
            if (cell_type::dimension(document_.cells.types[section.first_cell + i]) == cell_dimension_) {
              group.push_back(cell);
            }
          }
        }
      }
      std::ranges::move(of_zones.take(), std::back_inserter(groups));
    } else if (!has_groups && zones_.front().sections.all().size() > 1) {
      // Nothing else tells regions and sides apart.
      CgnsSectionGroups of_sections = group_cgns_sections(zones_.front().sections, document_.cells);
      std::ranges::move(of_sections.groups, std::back_inserter(groups));
      tells_sections = of_sections.are_joined;
    }
    std::vector<ListedGroup> listed;
    for (NamedSet& set : groups) {
      listed.push_back({0, std::move(set.name), std::move(set.members)});
    }
    add_listed_groups("cgns:group", std::move(listed), document_);
    if (tells_sections) {
      add_sections();
    }
    std::ranges::sort(linked_);
    linked_.erase(std::unique(linked_.begin(), linked_.end()), linked_.end());
    if (!linked_.empty()) {
      document_.implied_sets.push_back({std::string(link_set_name), std::move(linked_)});
    }
  }

  /// The section of each cell, from 1, for those to whom it is a region.
  void add_sections() {
    std::vector<std::int32_t> numbers;
    numbers.reserve(document_.cells.size());
    std::int32_t number = 0;
    for (const CgnsSection& section : zones_.front().sections.all()) {
      numbers.insert(numbers.end(), section.count, ++number);
    }
    document_.cell_arrays.push_back(make_data_array("cgns:section", 1, std::move(numbers)));
  }

  CgnsTree tree_;
  CgnsNode base_;
  int cell_dimension_ = 2;
  std::size_t axes_ = 3;
  bool has_float32_ = false;
  bool has_float64_ = false;
  std::map<std::string, std::vector<std::string>> families_;
  std::set<std::string> used_families_;
  std::vector<CgnsZone> zones_;
  NamedMembers of_points_;
  NamedMembers of_cells_;
  std::vector<std::int32_t> linked_;
  MeshDocument document_;
  std::vector<Hdf5Column> columns_;
};

}  // namespace

bool is_adf(std::string_view bytes) {
  constexpr std::size_t looked_at = 32;
  return bytes.substr(0, looked_at).find("ADF Database Version") != std::string_view::npos;
}

MeshDocument read_cgns(const std::filesystem::path& path, FileBytes bytes, const FileWorkers& /*workers*/) {
  if (is_adf(bytes)) {
    throw ReadError(path,
                    "is CGNS in its older form (ADF), which is not read: "
                    "'cgnsconvert -h in.cgns out.cgns' makes "
                    "a file of it that is");
  }
  auto [document, columns] = CgnsReader(path, bytes).read();
  document.original = make_hdf5_original(std::move(bytes), document.point_count(), std::move(columns));
  return std::move(document);
}

}  // namespace trismooth
