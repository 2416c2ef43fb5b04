#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

/// A mesh that a backend has made ready for smoothing, as often as the caller likes. Owns all it needs.
class PreparedSmoother {
 public:
  PreparedSmoother() = default;
  PreparedSmoother(const PreparedSmoother&) = delete;
  PreparedSmoother& operator=(const PreparedSmoother&) = delete;
  virtual ~PreparedSmoother() = default;

  /// Smooths the vertices' stored coordinates in place: sweeps in the local frame, and unless options.guard is off the
  /// never-worse commit. `frame` is local_frame() of the vertices that cells use, which the caller knows. Results are
  /// rounded to `storage`; vertices that do not move keep their bits. Coordinates are finite (the caller has checked).
  /// `fixed_quotient` is smallest_fixed_quotient() of the mesh. Where it throws DeviceError, some of the points may
  /// have been written.
  virtual SmoothingResult smooth(std::span<Point2<double>> points, const LocalFrame& frame, Storage storage,
                                 double fixed_quotient) = 0;
};

/// A mesh whose connectivity a backend has analysed by itself, for coordinates that change. Owns all it needs.
class PreparedMesh {
 public:
  PreparedMesh() = default;
  PreparedMesh(const PreparedMesh&) = delete;
  PreparedMesh& operator=(const PreparedMesh&) = delete;
  virtual ~PreparedMesh() = default;

  /// As SmoothingPlan::smooth(): the points, one for every vertex, smoothed in place, and untouched where it throws:
  /// see Overwriting for results that come in pieces.
  virtual SmoothingResult smooth(std::span<Point2<double>> points, Storage storage) = 0;

  /// Why each vertex is fixed, as MeshRings::fixed.
  virtual std::vector<std::uint8_t> fixed() const = 0;
};

/// Whoever runs the sweeps: the CPU, a GPU. Given the same rings, points and options, every backend gives the same
/// bits.
class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  /// "cpu", "cuda".
  virtual std::string name() const = 0;

  /// Makes a mesh ready: renumbering, colouring, whatever the backend needs. `points` are where the vertices are, in
  /// the local frame; they steer the order in memory and no result. Throws std::invalid_argument for options that the
  /// backend does not have.
  virtual std::unique_ptr<PreparedSmoother> prepare(const OneRings& rings, std::span<const Point2<double>> points,
                                                    const SmoothingOptions& options) const = 0;

  /// Finds the rings of a mesh with the backend's own means: what find_mesh_rings() finds, in every number, with the
  /// same errors. Nothing where the backend leaves that to the host. For Topology::device. With
  /// Execution::single_block the CUDA backend finds the neighbours by one thread, as the paper does.
  virtual std::optional<MeshRings> find_rings(std::span<const Point2<double>> /*points*/,
                                              std::span<const Triangle> /*triangles*/,
                                              const Constraints& /*constraints*/,
                                              const SmoothingOptions& /*options*/) const {
    return std::nullopt;
  }

  /// Analyses a mesh with the backend's own means and keeps what was found where the sweeps run. Null where the backend
  /// leaves that to the host. For Topology::device. Arguments and errors as those of SmoothingPlan's constructor.
  virtual std::unique_ptr<PreparedMesh> prepare_mesh(std::int32_t /*vertex_count*/,
                                                     std::span<const Triangle> /*triangles*/,
                                                     const Constraints& /*constraints*/,
                                                     const SmoothingOptions& /*options*/) const {
    return nullptr;
  }
};

/// The CPU backend. Layout and execution mean nothing to it; Order::unordered is refused.
const Backend& cpu_backend();

}  // namespace trismooth
