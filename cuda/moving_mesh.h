// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/base/index_view.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::cuda {

/// trismooth::MovingMesh for points in device memory, on the caller's stream: in every step positions of the boundary
/// come in and points go out there. The same bits as on the host. Where triangles are inverted by the carrying, the
/// mesh goes to the host, which untangles and smooths it, and back; the result says so (SmoothingResult::backend_note).
/// All work is queued on the stream; calls wait for it where they need an answer, and return when it is done. Can be
/// moved; what was moved from can be assigned to and destroyed, its functions throw std::logic_error. One thread at a
/// time may use it, with the device current that it was made on.
class [[nodiscard]] MovingMesh {
 public:
  /// `reference`: one point for every vertex, `triangles`, `constraints`: in memory of the host, as
  /// trismooth::MovingMesh has them, but for quadrilaterals, which follow there alone; copied. The stream stays the
  /// caller's and outlives the mesh. `options.backend` and `options.topology` mean nothing here. Throws what
  /// trismooth::MovingMesh throws, std::invalid_argument for four vertex numbers an element, and DeviceError where
  /// there is no device, its memory does not suffice, or a call fails. Complexity: linear, but for sorting the edges of
  /// each vertex.
  MovingMesh(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints = {},
             const SmoothingOptions& options = moving_options(), cudaStream_t stream = nullptr);
  MovingMesh(MovingMesh&&) noexcept;
  MovingMesh& operator=(MovingMesh&&) noexcept;
  ~MovingMesh();

  /// Puts the free vertices to where they belong, in place. `xy`: x and y of every vertex, in device memory, aligned to
  /// 16 bytes; those of held vertices are where they are now, and keep their bits; those of free ones are not looked
  /// at, but must be finite, and are rounded to `storage`. Throws std::invalid_argument, before anything runs, for a
  /// null pointer, one that is not aligned and memory of the host; MeshError for a coordinate that is not finite;
  /// DeviceError. `xy` is untouched then, as where options.cancel or options.time_limit_seconds end the call before the
  /// first sweep. Complexity: two linear systems, each linear in each of some ten steps, and that of Plan::smooth().
  FollowResult follow(double* xy, MovingStart start = MovingStart::reference, Storage storage = Storage::float64);
  /// Of coordinates of float, aligned to 8 bytes, to which free vertices are rounded. Throws as for double.
  FollowResult follow(float* xy, MovingStart start = MovingStart::reference);

  /// Has the last step not have happened, as where a solver repeats a time step with a smaller one: the last result is
  /// again the one before it. Throws std::logic_error where there is no such step: none yet, one that was taken back,
  /// go_on_from() since, or a call since that has begun and has not come to its end (its limits ended it before the
  /// first sweep, a callback has thrown): it has not happened, but what was before the step before it is gone.
  /// Complexity: constant.
  void take_back();

  /// Has these points, in memory of the host, be the last result: see trismooth::MovingMesh::go_on_from(). Throws
  /// std::invalid_argument for a wrong number of points, MeshError for a coordinate that is not finite; nothing has
  /// changed then. Complexity: linear.
  void go_on_from(const ConstPointView& points);

  /// Why each vertex is held, bits of namespace hold, 0 where nothing holds it. Throws std::logic_error where it has
  /// been moved from. Complexity: linear.
  [[nodiscard]] std::vector<std::uint8_t> held() const;

  /// The last result, in memory of the host; at first the reference. Throws std::logic_error where it has been moved
  /// from. Waits for the stream. Complexity: linear.
  [[nodiscard]] std::vector<Point2<double>> points() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trismooth::cuda
