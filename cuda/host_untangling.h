// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// The way of a mesh that has to be untangled: the host untangles it, and smooths it, which gives the same bits as the
/// device would. Meshes are hardly ever tangled, and what is worth a device is then over on the host soon.
class HostUntangling {
 public:
  /// `fixed`, `slidable`: as in MeshRings. Copies what it needs; all else waits for smooth().
  HostUntangling(std::vector<std::uint8_t> fixed, const ElementList& elements, const SmoothingOptions& options,
                 Slidable slidable = {});

  /// See PreparedSmoother::aim_at(): before the first smooth(). The reference orients the mesh then.
  void aim_at(std::span<const Point2<double>> reference, const LocalFrame& frame);

  /// As PreparedSmoother::smooth(), with what is invalid counted. The first points orient the mesh.
  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage, const LocalFrame& frame);

  /// What is to be told of a mesh that was not tangled, with its points as a device has left them. `reversed`: as
  /// MeshRings::reversed; `frame`: that of the input. Complexity: linear.
  UntanglingResult not_tangled(std::span<const std::uint8_t> reversed, std::span<const Point2<double>> points,
                               const LocalFrame& frame) const;

 private:
  std::vector<std::uint8_t> fixed_;
  OwnElements elements_;
  SmoothingOptions options_;
  Slidable slidable_;
  std::vector<Point2<double>> reference_;  ///< what is aimed at; empty: the points of each call
  LocalFrame frame_of_reference_;
  std::unique_ptr<PreparedSmoother> smoother_;
  std::vector<std::uint8_t> reversed_;  ///< as MeshRings::reversed, of the mesh that it has
};

}  // namespace trismooth::cuda
