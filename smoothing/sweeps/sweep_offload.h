// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/halo/halo.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/packed_rings.h"
#include "trismooth/smoothing/sweeps/sweep_tally.h"

namespace trismooth {

/// Sweeps over a part of a mesh that a device makes while the host, which runs all else, decides after each of them
/// whether there is another one. The positions stay on the device from the first sweep to the last.
template <class T>
class SweepOffload {
 public:
  SweepOffload() = default;
  SweepOffload(const SweepOffload&) = delete;
  SweepOffload& operator=(const SweepOffload&) = delete;
  virtual ~SweepOffload() = default;

  /// Takes the positions, packed, and what the mean-ratio method aims at (of other methods all null).
  virtual void begin(std::span<const Point2<T>> points, const MeanRatioTargets<T>& targets) = 0;
  /// The next sweep is the first of a stage: it evaluates every vertex.
  virtual void begin_stage() = 0;
  /// Makes a sweep, with the other parts, and says what it did here.
  virtual SweepTally<T> sweep(const MeanRatioStep<T>& step) = 0;
  /// The smallest quotient of the triangles with a free vertex, of this part.
  virtual T smallest_quotient() = 0;
  /// Brings the positions of free vertices and free ghosts back.
  virtual void end(std::span<Point2<T>> points) = 0;
};

/// Who makes them.
class SweepOffloads {
 public:
  SweepOffloads() = default;
  SweepOffloads(const SweepOffloads&) = delete;
  SweepOffloads& operator=(const SweepOffloads&) = delete;
  virtual ~SweepOffloads() = default;

  /// For a packed part. The arguments outlive what is made.
  virtual std::unique_ptr<SweepOffload<float>> in_single(const PackedRings& rings, const Halo& halo,
                                                         const SmoothingOptions& options) = 0;
  virtual std::unique_ptr<SweepOffload<double>> in_double(const PackedRings& rings, const Halo& halo,
                                                          const SmoothingOptions& options) = 0;
  /// The backend and the device by name, for the result.
  virtual std::string backend() const = 0;
  virtual std::string device() const = 0;
};

}  // namespace trismooth
