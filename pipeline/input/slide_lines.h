// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"
#include "trismooth/pipeline/input/element_cells.h"
#include "trismooth/pipeline/region_array.h"

namespace trismooth {

/// What a document says of the lines that vertices may slide on, for trismooth::Sliding.
struct SlideLines {
  std::vector<std::int32_t> lines;          ///< two points for each edge of its line cells, and for its named sides
  std::vector<std::int32_t> tags;           ///< one number a line: lines that the file's groups tell apart differ
  std::vector<std::int32_t> of_cell;        ///< the document's cell that each line is of; -1: a named side
  std::vector<std::int32_t> links;          ///< pairs of points that are periodic
  std::vector<std::string> notes;           ///< what the user should know, one sentence each
  std::vector<std::uint8_t> in_other_cell;  ///< one flag a point: of a cell that is neither triangle nor straight line
};

/// Groups are the cell arrays of `regions`, those of names under which programs write regions, those with names of
/// values for lines (physical groups, entities, references, markers), and others of whole numbers that do not number
/// the lines. Complexity: linear, and n log n in the lines.
SlideLines find_slide_lines(const MeshDocument& document, const ElementCells& mesh,
                            std::span<const RegionArray> regions);

}  // namespace trismooth
