// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_points.h"
#include "trismooth/quality/quadratic_quality.h"
#include "trismooth/smoothing/guard/stored_image.h"
#include "trismooth/smoothing/middle_nodes.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Workers;

/// A mesh whose vertices the sweeps have moved. All views are the caller's.
struct SweptMesh {
  const MeshRings& rings;  ///< of the mesh as it was read, in the input's numbering
  ElementList elements;
  std::span<const QuadraticElement> quadratics;  ///< those that have middles
  std::span<const MiddleNode> middles;           ///< those that follow their corners
  const LocalPoints& before;                     ///< all vertices as they were read, middles too
  std::span<const Point2<double>> swept;         ///< where the sweeps left them, in the plane; of middles: anything
};

/// The commit of what the sweeps have left, in any image: it places the vertices, stores them, and judges them until no
/// element, as it is stored, is worse than it was read (see keep_never_worse()): what is judged are the places of the
/// numbers that are stored, and of elements with middles whether they are valid, too. A vertex keeps its bits where it
/// has not moved, where it goes back, and where what it would be stored as is not finite. Middles follow their
/// corners (see MiddleNode), also where these go back. Without options.guard nobody is judged.
///
/// `stored`: the numbers of all vertices as they were read; they become those of the result. `points`: likewise their
/// places in the plane. Counts of `result`, which may have those of a guard of its own, are brought up to date: middles
/// are in none. Backends commit to the plane itself (numbers of a type, x and y) on their own, the CPU on its packed
/// vertices, a device behind its last sweep: by the same rounds, and without a way for the points in between.
/// Complexity: that of the guard.
void commit(const SweptMesh& mesh, const StoredImage& image, std::span<double> stored, std::span<Point2<double>> points,
            const SmoothingOptions& options, Workers& workers, SmoothingResult& result);

/// Brings a middle to where its corners take it. `read`: the numbers that were read of all vertices, `stored`:
/// those that are stored now.
void follow_corners(const MiddleNode& middle, const StoredImage& image, std::span<const double> read,
                    std::span<double> stored);

}  // namespace trismooth
