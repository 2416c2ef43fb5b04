#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/pipeline/ranks/joined/rank_topology.h"
#include "trismooth/pipeline/ranks/piece_files.h"
#include "trismooth/pipeline/region_array.h"

namespace trismooth {

/// The regions of a mesh in pieces. They are numbered by values, so all ranks mean the same by a number.
struct RankRegions {
  std::vector<RegionArray> arrays;       ///< the cell arrays that were obeyed, in the files' order
  std::vector<std::int32_t> of_overlap;  ///< one for each triangle of the overlap; empty where no array was obeyed
  std::vector<std::string> names;        ///< of each region, as Regions::names
  std::vector<std::string> notes;
};

/// What find_regions() finds in the whole mesh, by the same rules. Collective. Throws std::invalid_argument on all
/// ranks.
RankRegions find_rank_regions(const PieceFiles& files, const RankTopology& topology,
                              std::span<const std::string> names);

}  // namespace trismooth
