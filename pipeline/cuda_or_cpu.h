// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "trismooth/pipeline/auto_backend.h"
#include "trismooth/pipeline/cuda_support.h"
#include "trismooth/smoothing/cpu_backend.h"

namespace trismooth {

/// The backend that auto_backend() promises. Where a mesh is large enough for CUDA and the CPU finds its rings,
/// MeshRings::note says why. prepare_mesh() is left to the host: a mesh that is on a device alone cannot go on without
/// it.
class CudaOrCpu final : public Backend {
 public:
  /// `cuda.backend` and `cpu` must outlive this.
  explicit CudaOrCpu(CudaSupport cuda, const Backend& cpu = cpu_backend(),
                     std::int64_t free_vertices = free_vertices_for_cuda);

  /// "auto". Results name the backend that was taken.
  std::string name() const override { return "auto"; }

  /// Starts CUDA's default device for a large mesh.
  void start(std::int64_t vertices) const override;

  std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override;

  bool takes_quadrilaterals() const override { return true; }

  /// Before the rings are found, the vertices count as free. Where CUDA fails, the rings found by the host have the
  /// note of it.
  std::optional<MeshRings> find_rings(std::span<const Point2<double>> local, std::span<const Triangle> triangles,
                                      const Constraints& constraints, const SmoothingOptions& options) const override;

 private:
  bool is_large(std::int64_t vertices) const { return cuda_.backend != nullptr && vertices >= free_vertices_; }

  CudaSupport cuda_;
  const Backend& cpu_;
  std::int64_t free_vertices_;
};

}  // namespace trismooth
