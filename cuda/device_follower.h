// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/cuda/device_smoother.h"
#include "trismooth/cuda/host_untangling.h"
#include "trismooth/cuda/moving/device_carrier.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/runtime/context.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/runtime/host_copy.h"
#include "trismooth/cuda/topology/triangle_list.h"
#include "trismooth/smoothing/follower.h"
#include "trismooth/smoothing/moving/mesh_at_rest.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth::cuda {

/// Has a mesh follow its boundary on the current device. Where triangles are inverted by the carrying the host
/// untangles and smooths them.
class DeviceFollower final : public Follower {
 public:
  /// `mesh`, `rings`: as MeshAtRest's constructor leaves them; the mesh outlives the follower. `stream`: of someone
  /// else, who keeps it; none: its own. Throws DeviceError.
  DeviceFollower(const MeshAtRest& mesh, const MeshRings& rings, const SmoothingOptions& options,
                 std::optional<cudaStream_t> stream = std::nullopt);

  void follow(std::span<Point2<double>> points, Storage storage, MovingStart start, FollowResult& result) override;
  /// follow() of points in device memory, aligned to their size. Throws MeshError for a coordinate that is not finite.
  void follow_on_device(double* xy, Storage storage, MovingStart start, FollowResult& result);
  void follow_on_device(float* xy, Storage storage, MovingStart start, FollowResult& result);

  void take_back() override;
  void go_on_from(std::vector<Point2<double>> points) override;
  std::vector<Point2<double>> points() const override;

 private:
  /// The mesh to carry on from.
  struct Last {
    LocalFrame frame;                     ///< of the vertices that cells use
    std::vector<Point2<double>> of_held;  ///< where those of Carrier::held() are, as stored
  };

  TriangleList triangles() const;
  /// Follows what `stored_` has; the result is `previous_` then, or nothing has changed.
  void follow(Storage storage, MovingStart start, FollowResult& result);
  /// Puts where all vertices are carried to into `now_`. `of_held`: where those of Carrier::held() are.
  void carry(Storage storage, MovingStart start, std::vector<Point2<double>>& of_held, FollowResult& result);
  /// Smooths `now_`, in the frame of `extent_`.
  void smooth(Storage storage, SmoothingResult& result);
  /// Fills in what the result says of the mesh, `now_`.
  void look_at(FollowResult& result);

  const MeshAtRest& mesh_;
  const SmoothingOptions options_;
  Context context_;
  HostCopier copier_;
  std::int32_t count_;
  DeviceBuffer<Triangle> triangles_;
  DeviceBuffer<std::uint8_t> reversed_;
  DeviceBuffer<std::uint8_t> held_;        ///< MeshAtRest::held()
  DeviceBuffer<std::uint8_t> held_alone_;  ///< MeshAtRest::held_alone()
  DeviceBuffer<std::uint8_t> fixed_;       ///< MeshRings::fixed, layers among them
  DeviceBuffer<Point2<double>> rest_;
  DeviceBuffer<Point2<double>> rest_local_;
  DeviceBuffer<Point2<double>> previous_;
  DeviceBuffer<Point2<double>> stored_;  ///< the caller's
  DeviceBuffer<Point2<double>> now_;     ///< what is made of them; between calls the result before the last one
  DeviceBuffer<Point2<double>> local_;
  DeviceBuffer<Point2<double>> was_;  ///< where they are carried on from, in units of those
  DeviceCarrier carrier_;
  ExtentFinder extent_of_held_;
  ExtentFinder extent_;
  Last last_;
  Last before_last_;
  std::unique_ptr<DeviceSmoother> smoother_;
  std::optional<HostUntangling> untangling_;
};

}  // namespace trismooth::cuda
