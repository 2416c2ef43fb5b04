// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/mesh_io/data_array.h"
#include "trismooth/mesh_io/document/number_sites.h"

namespace trismooth {

/// `text` in place of the bytes from `begin` to `end`.
struct ByteEdit {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// Where the numbers of a point array of floating point stand.
struct VtkLegacyValues {
  std::size_t number = 0;  ///< of the array among the document's
  DataArray array;         ///< as it was read
  std::size_t begin = 0;   ///< of the first number in BINARY files; in ASCII ones, somewhere behind what is before it
};

/// What writing a legacy VTK file back needs to know of it.
struct VtkLegacyLayout {
  enum class Section : std::uint8_t { geometry, point_data, cell_data };

  bool binary = false;
  NumberSites coordinates;
  std::size_t type_offset = 0;  ///< of the word in the file that names the type of the coordinates
  std::size_t type_length = 0;
  std::size_t cell_count = 0;
  Section last_section = Section::geometry;   ///< the one that the file ends in, but for annotations
  std::vector<std::string> point_names;       ///< of every point array, those that a document cannot hold included,
  std::vector<std::string> cell_names;        ///< but for annotations
  std::vector<VtkLegacyValues> point_values;  ///< in the file's order
  std::vector<ByteEdit> without_annotations;  ///< what takes annotations out of the point and cell data
};

}  // namespace trismooth
