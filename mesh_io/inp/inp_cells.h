// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/mesh_io/inp/inp_model.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

/// Makes the ids of all scopes from their labels. Throws ReadError where two nodes, or two elements, of a scope have
/// one label.
void number_inp_items(InpModel& model);

/// The point or cell that has that label in the scope, or in the part that the scope is an instance of.
std::optional<std::int32_t> find_inp_item(const InpModel& model, std::size_t scope, InpItems InpScope::*kind,
                                          std::int64_t label);

/// The cells of all elements, in the file's order. The ids must be made. Throws ReadError where an element refers to a
/// node that there is not.
CellList make_inp_cells(const InpModel& model);

}  // namespace trismooth
