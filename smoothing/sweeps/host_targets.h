// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/packed_rings.h"

namespace trismooth {

/// What the mean-ratio method aims at, in memory of the host. `T`: float or double.
template <class T>
class HostTargets {
 public:
  /// None.
  HostTargets() = default;

  /// For smoothing from `points` (packed, local frame, working precision). `inverse_sizes`: of relative_sizes.h, by
  /// input number; empty: sizes are those that the mesh has. `halo`: of a part of a mesh; null: it is the whole.
  HostTargets(std::span<const Point2<T>> points, const PackedRings& rings, const MeanRatioOptions& options,
              Workers& workers, std::span<const double> inverse_sizes = {}, Halo* halo = nullptr);

  /// These, which are those of `reference`, where the mesh has moved to `points` (both packed, each in its local
  /// frame): sizes stay, and the shapes are turned as the edges around each vertex are. `exponents`: that of the frame
  /// of the points above that of the reference. No bound is below what is there. `rings`, `halo`: those that they were
  /// found with.
  HostTargets moved(std::span<const Point2<T>> reference, std::span<const Point2<T>> points, int exponents,
                    const PackedRings& rings, Workers& workers, Halo* halo = nullptr) const;

  /// What all vertices have in common.
  const MeanRatioMesh& mesh() const { return mesh_; }

  MeanRatioTargets<T> view() const {
    return {inverse_areas_.data(), largest_shares_.data(), &scales_, edges_.empty() ? nullptr : edges_.data()};
  }

 private:
  class Finder;

  /// For a frame whose exponent is larger by so much. MeanRatioScales have no lengths.
  void scale_by(int exponents);

  std::vector<T> inverse_areas_;   ///< one a vertex
  std::vector<T> largest_shares_;  ///< one a free vertex
  MeanRatioScales<T> scales_;
  MeanRatioMesh mesh_{};
  std::vector<EdgeTensor<T>> edges_;  ///< one a vertex, zeros of fixed ones; where shapes are to be kept
};

/// Another mesh whose sizes and shapes are aimed at.
template <class T>
struct ReferenceTargets {
  std::vector<Point2<T>> points;  ///< packed, in its local frame
  HostTargets<T> targets;
  int exponents = 0;  ///< see HostTargets::moved(), of the points at hand
};

}  // namespace trismooth
