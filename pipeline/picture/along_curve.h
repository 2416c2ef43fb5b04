// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/local_frame.h"
#include "trismooth/pipeline/picture/mesh_picture.h"

namespace trismooth {

class Workers;

/// Elements of a picture in an order in which those that are near each other in the plane are near each other in
/// memory.
struct OrderedPicture {
  /// They and their vertices alone, whose places are in the local frame. Vertices lie along a Hilbert curve. Triangles
  /// come before quadrilaterals, each kind by its first corner, which is the smallest, and corners run
  /// counter-clockwise as the mesh is now: reversed_after is empty, and reversed_before has those that were listed the
  /// other way, if there are any. Numbers are those of the file, in no order: no place_of() finds them, and nothing
  /// says how places are shown.
  MeshPicture mesh;
  BulkVector<std::int32_t> place_of_vertex;  ///< of those of the picture; -1 where they are not in `mesh`
  LocalFrame frame;                          ///< of all vertices of `mesh`, before and now
  Point2<double> low{0, 0};                  ///< the least of their coordinates, in the frame
};

/// The elements `shown` of the picture (their places, ascending), at most 2^30. Complexity: linear.
OrderedPicture along_curve(const MeshPicture& picture, std::span<const std::int32_t> shown, Workers& workers);

}  // namespace trismooth
