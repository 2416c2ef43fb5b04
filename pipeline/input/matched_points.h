// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/mesh_io/mesh_document.h"

namespace trismooth {

class Workers;

/// The points of another mesh of the same elements.
struct MatchedPoints {
  std::vector<double> points;      ///< x, y, z of every point of the mesh
  std::vector<std::string> notes;  ///< what the user should know, one sentence each
};

/// Where `other` has the points of `mesh`. Either its points have the same numbers, and its triangles and
/// quadrilaterals, with their nodes between corners, are those of `mesh`: from any corner on, in either sense of
/// rotation, and in any order. Or the elements are listed alike, and their nodes tell which point is which: then points
/// may be in other rows, and those that no element uses, of which the mesh keeps its own, may be missing. Throws
/// ReadError naming `other_path`, with what differs first, for another mesh. Complexity: linear, and n log n for
/// elements in another order.
MatchedPoints match_points(const MeshDocument& mesh, const std::filesystem::path& path, const MeshDocument& other,
                           const std::filesystem::path& other_path, Workers& workers);

}  // namespace trismooth
