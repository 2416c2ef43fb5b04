// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/pipeline/picture/mesh_lines.h"
#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

class Workers;

/// Numbers for a page, as its script unpacks them: whole numbers below 2^32, the bytes of one significance behind those
/// of another, deflated.
struct PackedStream {
  std::string name;
  std::size_t count = 0;  ///< of numbers
  int planes = 0;         ///< bytes of each
  std::size_t bytes = 0;  ///< deflated; 0 where there are none
};

/// A mesh as a page has it. Vertices are in an order of their own, in which those that are near each other in the plane
/// are near each other, triangles come before quadrilaterals, and corners run counter-clockwise in the picture's now.
/// Coordinates are whole numbers of steps from the origin; of the worst elements, and of those that are seen
/// otherwise so, the exact ones are kept beside.
struct PackedPicture {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t quadrilaterals = 0;
  Point2<double> origin;  ///< in the plane
  Point2<double> base;    ///< the origin in steps as exact places count them
  double step = 1;        ///< a power of 2
  std::vector<PackedStream> streams;
  std::string data;  ///< of all streams, base64
};

/// Packs the elements `shown` (their places, ascending), at most 2^30, and those of the picture's lines that are among
/// their sides. Complexity: linear.
PackedPicture pack_picture(const MeshPicture& picture, std::span<const std::int32_t> shown, const MeshLines& lines,
                           Workers& workers);

}  // namespace trismooth
