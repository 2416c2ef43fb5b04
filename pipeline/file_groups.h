// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace trismooth {

/// A set of points that a file names or implies, and what became of it.
struct FilePointSet {
  std::string name;
  std::int64_t vertices = 0;  ///< different ones
  bool is_area = false;       ///< it has all the triangles around one of its vertices: a part, not a line or points
  bool holds = false;         ///< whether its vertices are held
};

/// A set of cells that a file names. It holds nothing.
struct FileCellSet {
  std::string name;
  std::int64_t cells = 0;  ///< different ones
};

/// Line cells that a file calls by a name: a marker, a physical curve. They hold their vertices, as all lines do.
struct FileLineGroup {
  std::string name;
  std::int64_t vertices = 0;  ///< different ones
};

}  // namespace trismooth
