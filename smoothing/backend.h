// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

class Follower;
class MeshAtRest;

/// A mesh that a backend has made ready for smoothing, as often as the caller likes, whatever its coordinates are by
/// then. Owns all it needs.
class PreparedSmoother {
 public:
  PreparedSmoother() = default;
  PreparedSmoother(const PreparedSmoother&) = delete;
  PreparedSmoother& operator=(const PreparedSmoother&) = delete;
  virtual ~PreparedSmoother() = default;

  /// Smooths the vertices' stored coordinates in place: sweeps in the local frame, and unless options.guard is off the
  /// never-worse guard. Results are rounded to `storage`; vertices that do not move keep their bits. `frame` is the
  /// local frame of the vertices that cells use, for a caller who has found it already; without it, it is found here.
  /// Who made the mesh ready by prepare() has seen to it that all coordinates are finite; prepare_mesh() leaves that to
  /// this call, which throws MeshError. Whoever has the triangles counts the invalid ones of the result: the caller,
  /// but of a mesh prepared by prepare_mesh() the smoother. Where it throws DeviceError, points prepared by prepare()
  /// may have been written in part, those prepared by prepare_mesh() are untouched.
  virtual SmoothingResult smooth(std::span<Point2<double>> points, Storage storage,
                                 const std::optional<LocalFrame>& frame) = 0;

  /// From now on Method::mean_ratio aims at the sizes and shapes that the mesh has at `reference`, one point a vertex,
  /// in place of those at the points of each call; shapes are turned as the mesh is. `reference` is read once; `frame`
  /// is its local frame. Throws std::invalid_argument where the smoother has nothing of the kind.
  virtual void aim_at(std::span<const Point2<double>> /*reference*/, const LocalFrame& /*frame*/) {
    throw std::invalid_argument("a mesh that follows its boundary is smoothed on the CPU, or on one device");
  }

  /// Why each vertex is fixed, as MeshRings::fixed.
  virtual std::vector<std::uint8_t> fixed() const = 0;
};

/// Whoever runs the sweeps: the CPU, a GPU. Given the same mesh, points and options, every backend gives the same bits.
class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  /// "cpu", "cuda".
  virtual std::string name() const = 0;

  /// Throws DeviceError where it has nothing to run on.
  virtual void require_ready() const {}

  /// Starts what the backend is slow to start, a driver and its device, as far as a mesh of about so many vertices is
  /// worth that; returns when it has. For callers who have something else to do meanwhile: call it on a thread of its
  /// own, before or beside any other function. Nothing depends on it: what is not started then starts when it is
  /// needed, and what fails then fails again, and is told, where it is needed.
  virtual void start(std::int64_t /*vertices*/) const {}

  /// Makes a mesh ready whose rings are known: renumbering, colouring, whatever the backend needs. `mesh`:
  /// moved here, its memory is released as soon as it can be. `elements` are those of the mesh; they are looked at
  /// only where options.measures_shape() or options.untangles(). `local` are the vertices in the local frame; they
  /// steer the order in memory and no result. Throws std::invalid_argument for options that the backend does not have,
  /// and for elements that are not listed as triangles where it smooths triangles alone.
  virtual std::unique_ptr<PreparedSmoother> prepare(MeshRings mesh, const ElementList& elements,
                                                    std::span<const Point2<double>> local,
                                                    const SmoothingOptions& options) const = 0;

  /// Whether it smooths quadrilaterals; else triangles alone.
  virtual bool takes_quadrilaterals() const = 0;

  /// Whether it smooths those of a part of a mesh (MeshRings::part) as well.
  virtual bool takes_quadrilaterals_in_parts() const { return false; }

  /// prepare() for a caller who keeps the mesh. It is copied where the backend has no other way.
  virtual std::unique_ptr<PreparedSmoother> prepare_kept(const MeshRings& mesh, const ElementList& elements,
                                                         std::span<const Point2<double>> local,
                                                         const SmoothingOptions& options) const {
    return prepare(mesh, elements, local, options);
  }

  /// Finds the rings of a mesh with the backend's own means: what find_mesh_rings() finds, in every number, with the
  /// same errors, but for MeshRings::slidable. The constraints name no vertices of lines. Nothing where the backend
  /// leaves that to the host. For Topology::device. With Execution::single_block the CUDA backend finds the neighbours
  /// by one thread, as the paper does.
  virtual std::optional<MeshRings> find_rings(std::span<const Point2<double>> /*local*/,
                                              std::span<const Triangle> /*triangles*/,
                                              const Constraints& /*constraints*/,
                                              const SmoothingOptions& /*options*/) const {
    return std::nullopt;
  }

  /// Makes a mesh ready whose rings are not known: the backend analyses it with its own means, and keeps what was found
  /// where the sweeps run. Null where the backend leaves that to the host. For Topology::device. Arguments and errors
  /// as those of SmoothingPlan's constructor, but the constraints name no vertices of lines.
  virtual std::unique_ptr<PreparedSmoother> prepare_mesh(std::int32_t /*vertex_count*/,
                                                         std::span<const Triangle> /*triangles*/,
                                                         const Constraints& /*constraints*/,
                                                         const SmoothingOptions& /*options*/) const {
    return nullptr;
  }

  /// Makes a mesh ready that follows its boundary, which is carried along on the host unless the backend has a way of
  /// its own. `mesh`, `rings`: as MeshAtRest's constructor leaves them; the mesh outlives the follower. Throws as
  /// prepare(), and as PreparedSmoother::aim_at().
  virtual std::unique_ptr<Follower> follower(const MeshAtRest& mesh, MeshRings rings,
                                             const SmoothingOptions& options) const;
};

}  // namespace trismooth
