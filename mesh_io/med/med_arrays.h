// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/cells/cell_groups.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Arrays as a field of MED: of points, of cells, or both of one name, of the same components and numbers.
struct MedField {
  std::string name;
  const DataArray* at_points = nullptr;  ///< of the document; null: none
  const DataArray* at_cells = nullptr;   ///< likewise

  const DataArray& any() const { return at_points != nullptr ? *at_points : *at_cells; }
};

struct MedFieldPlan {
  std::vector<MedField> fields;      ///< no two of a name
  std::vector<std::string> renamed;  ///< "'a/b' (as a_b)"
};

/// Characters of the name of a field.
inline constexpr std::size_t med_field_name_size = 64;

/// The arrays of the document, which outlives the result, but the cell arrays that groups are from. Complexity: n log n
/// in the arrays.
MedFieldPlan plan_med_fields(const MeshDocument& document, const GroupArrays& left_out);

/// What a field's numbers are written as: those of files since MED 3.0, which has none of 32 bits with a fraction.
ScalarType med_field_type(const DataArray& array);

}  // namespace trismooth
