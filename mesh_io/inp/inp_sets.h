// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "trismooth/mesh_io/inp/inp_model.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// The set of that name ("Set-1" or "Plate-1.Set-1") as lines of the scope mean it.
std::optional<std::size_t> find_inp_set(const InpModel& model, std::size_t scope, InpItems InpScope::*kind,
                                        std::string_view text);

/// Finds the members of all sets of the model, whose ids must be made; `cells` are its elements. Returns how many
/// numbers and names there are in the sets' lines that name nothing. Throws ReadError where sets of sets have more
/// members than a file of that size can mean.
std::size_t find_inp_members(InpModel& model, const CellList& cells);

/// Adds the regions, as a cell array, and all other sets to the document, which has the cells of the model.
void add_inp_sets(const InpModel& model, MeshDocument& document);

}  // namespace trismooth
