// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/cuda/topology/rings.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"

namespace trismooth::cuda {

/// A packed mesh on the device with all that it takes to smooth its coordinates again and again.
class DeviceSmoother {
 public:
  DeviceSmoother() = default;
  DeviceSmoother(const DeviceSmoother&) = delete;
  DeviceSmoother& operator=(const DeviceSmoother&) = delete;
  virtual ~DeviceSmoother() = default;

  /// Whether a triangle with a free vertex is inverted or degenerate, or so near to it that only the host can tell.
  /// Arguments as those of smooth(). Waits for the device.
  virtual bool is_tangled(const Point2<double>* stored, const LocalFrame* frame) = 0;

  /// Reads the sizes that the options ask for, if they do: before every smooth(), and where they fit. Throws
  /// std::invalid_argument as said at MeanRatioOptions::target_lengths. `fixed`: as MeshRings::fixed.
  virtual void read_sizes(std::span<const std::uint8_t> fixed) = 0;

  /// PreparedSmoother::aim_at(), for stored coordinates on the device; `exponent`: that of their local frame. Throws
  /// DeviceError.
  virtual void aim_at(const Point2<double>* stored, const LocalFrame* frame, int exponent) = 0;

  /// Has vertices slide from now on; see MeshRings::slidable. `reversed`: as MeshRings::reversed, of its triangles.
  /// Waits for the device.
  virtual void slide_on(Slidable slidable, std::vector<std::uint8_t> reversed) = 0;
  /// Whether there is a vertex with a ring. Where there is none nothing slides, either: the host has to do that.
  virtual bool has_free_vertices() const = 0;

  /// Smooths coordinates in device memory (aligned to 16 bytes), in the caller's numbering, in place: sweeps, guard.
  /// They are finite, and nothing is untangled. `frame`: their local frame, on the device. `fixed_quotient`: see
  /// PreparedSmoother::smooth(). Fills all of the result but transfers and preparation. From the call on until the
  /// result is written the device is not waited for, unless there is a callback, a time limit or a quality target to
  /// ask.
  virtual SmoothingResult smooth(Point2<double>* stored, const LocalFrame* frame, Storage storage,
                                 double fixed_quotient) = 0;
};

/// Packs rings in input numbering for these options and makes the smoother for them. `points`: one for every vertex,
/// local frame, on the device; they steer the order in memory. Both give their memory back. `context` outlives the
/// smoother.
std::unique_ptr<DeviceSmoother> make_device_smoother(Context& context, DeviceRings rings,
                                                     DeviceBuffer<Point2<double>> points,
                                                     const SmoothingOptions& options);

}  // namespace trismooth::cuda
