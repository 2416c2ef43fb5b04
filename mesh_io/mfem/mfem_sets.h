// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/document/member_budget.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// A name for attributes of elements, or of elements of the boundary.
struct MfemSet {
  std::string name;
  int dimension;  ///< of the cells that have the attributes
  std::vector<std::int64_t> attributes;
};

/// Gives the document the cell array "mfem:attribute", `attributes` for its cells, and names: a set of one attribute
/// names that attribute, the first such set each; the others become sets of cells. Complexity: n log a for a
/// attributes, and the members of all sets. Throws ReadError where these are beyond the budget.
void name_mfem_attributes(std::span<const MfemSet> sets, std::span<const std::int32_t> attributes, MemberBudget budget,
                          MeshDocument& document);

}  // namespace trismooth
