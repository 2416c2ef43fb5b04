// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/mesh_io/nastran/nastran_card.h"
#include "trismooth/mesh_io/nastran/nastran_model.h"

namespace trismooth {

/// Where a card that constrains or loads nodes names these.
struct NastranHolder {
  std::string_view name;
  bool has_set = true;    ///< its first field is the number of a set
  std::uint8_t list = 0;  ///< from that field on, all are nodes, "THRU" between two for all from one to the other
  std::uint8_t nodes_of_row = 0;  ///< bits: fields 0 to 7 that are nodes, of the first row ...
  bool every_row = false;         ///< ... or of every one
};

/// The one of that name (in upper case), or nullptr.
const NastranHolder* find_nastran_holder(std::string_view name);

/// The numbers of the nodes that such a card names. What is no number is passed over.
std::vector<NastranRange> nodes_of_nastran_card(const NastranHolder& holder, const NastranCard& card);

}  // namespace trismooth
