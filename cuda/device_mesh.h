// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <cuda_runtime_api.h>

#include "trismooth/cuda/device_constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

/// Smoothing of meshes that are in device memory already, on the caller's stream.
namespace trismooth::cuda {

/// A mesh in device memory. The caller owns all arrays.
struct DeviceMesh {
  std::int32_t vertex_count = 0;
  std::int32_t element_count = 0;
  const std::int32_t* elements = nullptr;  ///< corners element_count vertex indices from 0, listed in either direction
  DeviceConstraints constraints{};         ///< arrays on the device; all may be absent
  std::int32_t corners = 3;                ///< numbers of each element: 3, of triangles, or 4 where quadrilaterals may
                                           ///< be among them: corners in turn, -1 in the last place of a triangle
};

/// A mesh whose connectivity is analysed once and stays on the device; coordinates are smoothed as often as they
/// change. Of triangles, however many numbers each has, the device analyses it. Where quadrilaterals are among them the
/// host does, and keeps copies of elements and constraints, and of the coordinates it looks at those of the first call
/// for layers; the results say so (SmoothingResult::backend_note). All work is queued on the stream; calls wait for it
/// where they need an answer, and return when it is done.
class Plan {
 public:
  /// `mesh.elements` must stay as they are for as long as the plan lives; the constraints are read now. The stream
  /// stays the caller's and outlives the plan. `options.backend` and `options.topology` mean nothing here;
  /// `options.mean_ratio.target_lengths` are in memory of the host, here as elsewhere.
  /// Throws MeshError for elements that are no mesh, std::invalid_argument for options or constraints that do not fit,
  /// and for executions that know triangles alone where quadrilaterals are among them, DeviceError where there is no
  /// device, its memory does not suffice, or a call fails. Before anything runs: std::invalid_argument, which names the
  /// array, for a null pointer, one that is not aligned to the numbers behind it, and memory of the host that the
  /// device cannot read.
  Plan(const DeviceMesh& mesh, const SmoothingOptions& options, cudaStream_t stream = nullptr);
  /// What was moved from can be assigned to and destroyed; all else throws std::logic_error.
  Plan(Plan&&) noexcept;
  Plan& operator=(Plan&&) noexcept;
  ~Plan();

  /// Smooths `xy` (x and y of every vertex, in device memory) in place: aligned to 16 bytes, `float` to 8, as device
  /// allocations are. Throws std::invalid_argument where it is not, or null, or memory of the host, before anything
  /// runs. Where vertices are that no element and no other cell uses changes nothing. Vertices that do not move keep
  /// their bits, the others are rounded to `storage`, or to float. The first call also finds orientation and rings and
  /// orders the mesh in memory; a later one repeats that only if the majority
  /// orientation of a component has changed. Throws MeshError for a coordinate that is not finite, DeviceError; `xy` is
  /// untouched then, unless the device failed in the very last step, which writes it.
  SmoothingResult smooth(double* xy, Storage storage = Storage::float64);
  /// Smooths coordinates of float; results are rounded to float.
  SmoothingResult smooth(float* xy);

  /// Why each vertex is fixed: the bits of namespace hold, as MeshRings::fixed. Waits for the stream.
  std::vector<std::uint8_t> fixed() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A Plan and its smooth(), once: analysis, sweeps and guard of a mesh in device memory, where it stays.
SmoothingResult smooth(const DeviceMesh& mesh, double* xy, const SmoothingOptions& options = {},
                       cudaStream_t stream = nullptr);
/// A Plan and its smooth(), once, for coordinates of float.
SmoothingResult smooth(const DeviceMesh& mesh, float* xy, const SmoothingOptions& options = {},
                       cudaStream_t stream = nullptr);

}  // namespace trismooth::cuda
