// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/base/cell_list.h"
#include "trismooth/mesh_io/cgns/cgns_tree.h"

namespace trismooth {

/// Elements that a zone lists together under numbers that count on.
struct CgnsSection {
  std::string name;
  std::int64_t first_number = 1;
  std::size_t count = 0;
  std::size_t first_cell = 0;
  std::int64_t type = 0;  ///< ElementType_t
};

/// The sections of a zone.
class CgnsSections {
 public:
  CgnsSections() = default;
  /// In the order of their numbers, none of which is in two.
  explicit CgnsSections(std::vector<CgnsSection> sections) : sections_(std::move(sections)) {}

  const std::vector<CgnsSection>& all() const { return sections_; }
  /// The cell of the element of that number. Logarithmic time.
  std::optional<std::int32_t> find(std::int64_t number) const;
  /// The highest number of all elements; 0 where there are none.
  std::int64_t last_number() const;

 private:
  std::vector<CgnsSection> sections_;
};

/// A zone of unstructured elements as a part of the document.
struct CgnsZone {
  CgnsNode node;
  std::size_t first_point = 0;
  std::size_t points = 0;
  CgnsSections sections;
};

/// Appends the elements of the zone, whose points are those from `first_point`
/// on, to the cells, in the order of their numbers. Throws ReadError.
/// Complexity: linear in the elements.
CgnsSections read_cgns_sections(CgnsTree& tree, const CgnsNode& zone, std::size_t first_point, std::size_t points,
                                CellList& cells);

}  // namespace trismooth
