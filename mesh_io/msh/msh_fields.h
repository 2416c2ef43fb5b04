// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "trismooth/mesh_io/bytes/ordered_blocks.h"
#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/msh/msh_input.h"

namespace trismooth {

/// The nodes or elements that a section $NodeData or $ElementData has rows of.
struct MshFieldRows {
  bool of_nodes = true;
  std::size_t size = 0;
  std::span<const std::int64_t> tags{};    ///< of every row; empty: they count from 1
  std::span<const std::int32_t> places{};  ///< the row of the array that each row shows; empty: the same
};

/// How many numbers a row of the array has in an MSH file, which is 1, 3 or 9; 0: it cannot be there.
std::size_t msh_components(const DataArray& array);

/// Writes the array as such a section, under its name, in the encoding that the header says. Tags are ints. Nothing
/// where msh_components() is 0.
void write_msh_field(OrderedBlocks& blocks, const MshHeader& header, const MshFieldRows& rows, const DataArray& array);

/// The name as a file can have it: without quotation marks, on one line.
std::string plain_msh_name(std::string_view name);

/// plain_msh_name() between quotation marks.
std::string quoted_msh_name(std::string_view name);

}  // namespace trismooth
