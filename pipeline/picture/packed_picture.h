// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/pipeline/picture/along_curve.h"
#include "trismooth/pipeline/picture/mesh_lines.h"

namespace trismooth {

class Workers;

/// Numbers for a page, as its script unpacks them: whole numbers below 2^32, the bytes of one significance behind those
/// of another, deflated.
struct PackedStream {
  std::string name;
  std::size_t count = 0;  ///< of numbers
  int planes = 0;         ///< bytes of each
  std::size_t bytes = 0;  ///< deflated
  std::string text;       ///< they and up to two more, a multiple of three, base64
};

/// A mesh as a page has it, in the order of an OrderedPicture. Coordinates are whole numbers of steps from the origin;
/// of the worst elements, and of those that are seen otherwise so, the exact ones are kept beside.
struct PackedPicture {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t quadrilaterals = 0;
  Point2<double> origin;              ///< in the plane
  Point2<double> base;                ///< the origin in steps as exact places count them
  double step = 1;                    ///< a power of 2
  std::vector<PackedStream> streams;  ///< of numbers that there are any of
};

/// Packs a picture with its lines, whose ends are its vertices. Complexity: linear.
PackedPicture pack_picture(const OrderedPicture& ordered, const MeshLines& lines, Workers& workers);

}  // namespace trismooth
