// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/file_groups.h"

namespace trismooth {

/// Which implied sets of the file a point is in: bits.
namespace implied {
inline constexpr std::uint8_t points = 1;
inline constexpr std::uint8_t curves = 2;
}  // namespace implied

/// What a rank has read of a mesh file: a contiguous range of its points and one of its cells, those of rank 0 first,
/// either of which may be empty. The ranges of all ranks make the file.
struct MeshShare {
  /// The corners of its cells are numbers of points in the whole file, from 0; all else is of the ranges. What the
  /// file says beside points and cells (field arrays, notes, losses) rank 0 has.
  MeshDocument document;
  std::vector<std::uint8_t> held_by_sets;  ///< one flag a point: 1 where a set of the file holds it; or none
  /// One a point, bits of namespace implied, where it is not known yet which points of these sets are inside; or none.
  std::vector<std::uint8_t> implied_by;

  /// Numbers in the whole file of points that the user names by their labels; rank 0 has them.
  std::vector<std::int64_t> labelled;

  // For the report; rank 0 has them.
  std::vector<FilePointSet> point_sets;
  std::vector<FileCellSet> cell_sets;
  std::vector<FileLineGroup> line_groups;
  std::vector<std::string> notes;
};

}  // namespace trismooth
