// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trismooth/base/box.h"
#include "trismooth/pipeline/picture/colours.h"
#include "trismooth/pipeline/picture/element_shades.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

/// What a still picture shows, and how large it is.
struct StillOptions {
  int width = 1200;  ///< in pixels, at least 1
  int height = 900;
  std::optional<Box> window;  ///< of the plane, in the file's unit, as large as it fits; absent: all of the mesh
  PictureValue value;         ///< what elements are coloured by
  bool before = false;        ///< the mesh as it was, not as it is now
  bool lines = true;          ///< also boundary, interfaces, and the edges of elements that are large enough
  int threads = 1;            ///< 0: all. The picture does not depend on it
};

/// Pixels, row by row from above, of three bytes each: red, green, blue.
struct StillPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// All of the elements and some room around them, in the file's unit.
Box with_room(const Box& elements);

/// Draws a mesh. Of several elements in one pixel the worst is seen, also where it is smaller than the pixel; edges are
/// drawn of elements whose mean edge is above 6 pixels. Complexity: linear in elements and pixels. Throws what
/// ElementShades does.
StillPicture draw_still(const MeshPicture& picture, const StillOptions& options);

/// The same of shades and lines that are there, whose value and state count. Without lines, where `lines` is null.
StillPicture draw_still(const ElementShades& shades, const MeshLines* lines, const StillOptions& options);

}  // namespace trismooth
