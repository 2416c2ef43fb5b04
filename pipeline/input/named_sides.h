// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trismooth {

struct MeshDocument;
struct ElementCells;

/// Sides of elements that a document's cell arrays mark as named boundaries (is_side_name() in region_names.h). They
/// are to a mesh what line cells are: they hold their vertices, or these slide along them.
struct NamedSides {
  std::vector<std::int32_t> lines;  ///< two points a side, ascending; each side once
  std::vector<std::int32_t> tags;   ///< a number from 0 for each: those of other boundaries differ
  std::string names;                ///< of the arrays that mark any: "'skfem:b:wall', 'skfem:b:inlet'"

  std::int64_t count() const { return static_cast<std::int64_t>(tags.size()); }
};

/// Those of the mesh's elements, but for strips. Arrays that hold other than whole numbers mark none. Complexity:
/// n log n in the sides that are marked, and linear in the elements for each such array.
NamedSides find_named_sides(const MeshDocument& document, const ElementCells& mesh);

}  // namespace trismooth
