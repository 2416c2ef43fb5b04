#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/coordinate_sites.h"

namespace trismooth {

/// What writing a legacy VTK file back needs to know of it.
struct VtkLegacyLayout {
  enum class Section : std::uint8_t { geometry, point_data, cell_data };

  bool binary = false;
  CoordinateSites coordinates;
  Section last_section = Section::geometry;  ///< the one that the file ends in
  std::vector<std::string> point_names;      ///< of every point array, those that a document cannot hold included
  std::vector<std::string> cell_names;
};

}  // namespace trismooth
