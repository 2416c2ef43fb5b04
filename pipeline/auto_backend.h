#pragma once

#include <cstdint>
#include <string>

#include "trismooth/pipeline/cuda_support.h"

namespace trismooth {

/// From this many free vertices on, smoothing on a GPU pays for starting CUDA and for the transfers there and back:
/// measured on an H200 beside 16 cores, where a start takes a third of a second (benchmarks/results). With fewer cores
/// it pays earlier.
inline constexpr std::int64_t free_vertices_for_cuda = 1'000'000;

/// Takes CUDA where a device can be used and the mesh is large enough, else the CPU. Where CUDA fails, also in the
/// middle of a smoothing, the CPU does the whole work from the beginning: the bits are the same. Where a mesh is large
/// enough for CUDA and the CPU smooths it or finds its rings, SmoothingResult::backend_note or MeshRings::note says
/// why. prepare_mesh() is left to the host: a mesh that is on a device alone cannot go on without it. Several threads
/// may use one at the same time.
class AutoBackend final : public Backend {
 public:
  /// `cuda.backend` and `cpu` must outlive this.
  explicit AutoBackend(CudaSupport cuda, const Backend& cpu = cpu_backend(),
                       std::int64_t free_vertices = free_vertices_for_cuda);

  /// "auto". Results name the backend that was taken.
  std::string name() const override { return "auto"; }

  std::unique_ptr<PreparedSmoother> prepare(const MeshRings& mesh, std::span<const Triangle> triangles,
                                            std::span<const Point2<double>> local,
                                            const SmoothingOptions& options) const override;

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
