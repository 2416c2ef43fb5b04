// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/cgns/cgns_sections.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "trismooth/mesh_io/cgns/cgns_elements.h"

namespace trismooth {

namespace {

/// Before its nodes are read.
struct StatedSection {
  CgnsNode node;
  std::int64_t type;
  std::int64_t first;
  std::int64_t last;
};

class CgnsSectionsReader {
 public:
  CgnsSectionsReader(CgnsTree& tree, std::size_t first_point, std::size_t points, CellList& cells)
      : tree_(tree), first_point_(first_point), points_(points), cells_(cells) {}

  CgnsSections read(const CgnsNode& zone) {
    std::vector<StatedSection> stated;
    for (CgnsNode& node : tree_.children(zone.path, "Elements_t")) {
      stated.push_back(read_head(std::move(node)));
    }
    std::ranges::sort(stated, {}, &StatedSection::first);  // (Two of one first number are refused.)
    std::vector<CgnsSection> sections;
    for (std::size_t i = 0; i < stated.size(); ++i) {
      const StatedSection& section = stated[i];
      if (i > 0 && section.first <= stated[i - 1].last) {
        tree_.fail_at(section.node, "has numbers of elements that the section before it has, too");
      }
      const std::size_t first_cell = cells_.size();
      read_nodes(section);
      sections.push_back({section.node.name, section.first, cells_.size() - first_cell, first_cell, section.type});
    }
    return CgnsSections(std::move(sections));
  }

 private:
  StatedSection read_head(CgnsNode node) {
    const std::vector<std::int64_t> types = tree_.integers(node);
    const auto range = tree_.child(node, "ElementRange", "IndexRange_t");
    const std::vector<std::int64_t> numbers = range ? tree_.integers(*range) : std::vector<std::int64_t>();
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    if (types.empty() || numbers.size() != 2 || numbers[0] < 1 || numbers[1] < numbers[0] - 1 || numbers[1] > most) {
      tree_.fail_at(node, "has no type and range of elements that are read");
    }
    if (types[0] != cgns_type::mixed && types[0] != cgns_type::polygons && find_cgns_element(types[0]) == nullptr) {
      tree_.fail_at(node, "has elements of the type " + std::to_string(types[0]) + ", which is not read");
    }
    return {std::move(node), types[0], numbers[0], numbers[1]};
  }

  std::vector<std::int64_t> list(const CgnsNode& section, std::string_view name) {
    const auto node = tree_.child(section, name, "DataArray_t");
    return node && !tree_.data_of(*node).empty() ? tree_.integers(*node) : std::vector<std::int64_t>();
  }

  void read_nodes(const StatedSection& section) {
    const std::vector<std::int64_t> nodes = list(section.node, "ElementConnectivity");
    const auto count = static_cast<std::size_t>(section.last - section.first + 1);
    if (count + cells_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      tree_.fail("has more elements than 32-bit indices can tell apart");
    }
    if (const CgnsElement* const element = find_cgns_element(section.type)) {
      if (nodes.size() % element->nodes != 0 || nodes.size() / element->nodes != count) {
        fail_count(section, nodes.size());
      }
      for (std::size_t i = 0; i < count; ++i) {
        append(section, *element, std::span(nodes).subspan(i * element->nodes, element->nodes));
      }
    } else {
      // Each behind its type, or polygons in old files behind the number of
      // their nodes.
      read_different(section, nodes, count);
    }
  }

  void read_different(const StatedSection& section, std::span<const std::int64_t> nodes, std::size_t count) {
    const std::vector<std::int64_t> begins = list(section.node, "ElementStartOffset");
    const bool are_polygons = section.type == cgns_type::polygons;
    if (!begins.empty() &&
        (begins.size() != count + 1 || begins.front() != 0 ||
         begins.back() != static_cast<std::int64_t>(nodes.size()) || !std::ranges::is_sorted(begins))) {
      tree_.fail_at(section.node,
                    "has no offsets (ElementStartOffset) from 0 "
                    "up to the number of its nodes");
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (are_polygons && !begins.empty()) {
        append_polygon(section, nodes.subspan(static_cast<std::size_t>(begins[i]),
                                              static_cast<std::size_t>(begins[i + 1] - begins[i])));
        at = static_cast<std::size_t>(begins[i + 1]);
        continue;
      }
      const std::int64_t head = at < nodes.size() ? nodes[at++] : 0;
      const CgnsElement* const element = are_polygons ? nullptr : find_cgns_element(head);
      if (!are_polygons && element == nullptr) {
        tree_.fail_at(section.node, "has an element of the type " + std::to_string(head) + ", which is not read");
      }
      const std::int64_t size = are_polygons ? head : static_cast<std::int64_t>(element->nodes);
      if (size < 0 || size > static_cast<std::int64_t>(nodes.size() - at)) {
        fail_count(section, nodes.size());
      }
      const auto own = nodes.subspan(at, static_cast<std::size_t>(size));
      are_polygons ? append_polygon(section, own) : append(section, *element, own);
      at += own.size();
    }
    if (at != nodes.size()) {
      fail_count(section, nodes.size());
    }
  }

  [[noreturn]] void fail_count(const StatedSection& section, std::size_t nodes) const {
    tree_.fail_at(section.node, "has " + std::to_string(nodes) + " numbers, which are not those of the elements " +
                                    std::to_string(section.first) + " to " + std::to_string(section.last));
  }

  void append(const StatedSection& section, const CgnsElement& element, std::span<const std::int64_t> nodes) {
    for (std::size_t k = 0; k < element.nodes; ++k) {
      cells_.connectivity.push_back(point_of(section, nodes[element.place(k)]));
    }
    close(element.type);
  }

  void append_polygon(const StatedSection& section, std::span<const std::int64_t> nodes) {
    if (nodes.size() < 3) {
      tree_.fail_at(section.node, "has a polygon of fewer than 3 nodes");
    }
    for (const std::int64_t node : nodes) {
      cells_.connectivity.push_back(point_of(section, node));
    }
    close(cell_type::polygon);
  }

  void close(std::uint8_t type) {
    cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
    cells_.types.push_back(type);
  }

  std::int32_t point_of(const StatedSection& section, std::int64_t node) const {
    if (node < 1 || node > static_cast<std::int64_t>(points_)) {
      tree_.fail_at(section.node, "names vertex " + std::to_string(node) + "; its zone has " + std::to_string(points_) +
                                      ", counted from 1");
    }
    return static_cast<std::int32_t>(first_point_ + static_cast<std::size_t>(node - 1));
  }

  CgnsTree& tree_;
  std::size_t first_point_;
  std::size_t points_;
  CellList& cells_;
};

}  // namespace

std::optional<std::int32_t> CgnsSections::find(std::int64_t number) const {
  const auto behind = std::ranges::upper_bound(sections_, number, {}, &CgnsSection::first_number);
  if (behind == sections_.begin()) {
    return std::nullopt;
  }
  const CgnsSection& section = *(behind - 1);
  const auto place = static_cast<std::size_t>(number - section.first_number);
  return place < section.count ? std::optional(static_cast<std::int32_t>(section.first_cell + place)) : std::nullopt;
}

std::int64_t CgnsSections::last_number() const {
  return sections_.empty() ? 0 : sections_.back().first_number + static_cast<std::int64_t>(sections_.back().count) - 1;
}

CgnsSections read_cgns_sections(CgnsTree& tree, const CgnsNode& zone, std::size_t first_point, std::size_t points,
                                CellList& cells) {
  return CgnsSectionsReader(tree, first_point, points, cells).read(zone);
}

}  // namespace trismooth
