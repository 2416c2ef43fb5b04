#pragma once

#include <memory>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth::cuda {

/// The way of a mesh that has to be untangled: the host untangles it, and smooths it, which gives the same bits as the
/// device would. Meshes are hardly ever tangled, and what is worth a device is then over on the host soon.
class HostUntangling {
 public:
  /// Copies what it needs. Costs little until smooth() is called.
  HostUntangling(MeshRings mesh, std::span<const Triangle> triangles, const SmoothingOptions& options);

  /// As PreparedSmoother::smooth(), without a frame.
  SmoothingResult smooth(std::span<Point2<double>> points, Storage storage);

 private:
  MeshRings mesh_;
  std::vector<Triangle> triangles_;
  SmoothingOptions options_;
  std::unique_ptr<PreparedSmoother> smoother_;
};

/// The same for a mesh whose rings are not known on the host. `fixed`: as MeshRings::fixed.
SmoothingResult untangle_on_host(std::vector<std::uint8_t> fixed, std::span<const Triangle> triangles,
                                 const SmoothingOptions& options, std::span<Point2<double>> points, Storage storage);

}  // namespace trismooth::cuda
