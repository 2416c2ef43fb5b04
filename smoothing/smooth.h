// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/array_view.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// A mesh whose connectivity is analysed once and whose coordinates are smoothed as often as they change (moving
/// meshes). Owns copies of all it needs; the caller's arrays may go, but for options.mean_ratio.target_lengths, which
/// smooth() reads. Can be moved; what was moved from can be assigned
/// to and destroyed, its smooth() throws std::logic_error. One thread at a time may use a plan; several plans may be
/// used at the same time. With a backend that runs on a device: from threads that have the same device current.
class [[nodiscard]] SmoothingPlan {
 public:
  /// `triangles`: three vertex numbers each, from 0, listed in either direction; orientation is made consistent per
  /// component (triangles connected through edges of exactly two triangles). Best each once: the corners of one that is
  /// listed again are held; find_repeated_triangles() in base/repeated_triangles.h finds them. Throws MeshError for
  /// triangles that are no
  /// mesh: an index out of range, a triangle that repeats a vertex, a component that cannot be oriented, more than
  /// 2,147,483,647 vertices or 715,827,882 triangles. Throws std::invalid_argument for options or constraints that do
  /// not fit. Complexity: linear, but for sorting the edges of each vertex.
  SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                const SmoothingOptions& options = {});
  /// A plan without constraints: fixed is what the mesh itself holds.
  SmoothingPlan(std::int64_t vertex_count, const IndexView& triangles, const SmoothingOptions& options = {});
  SmoothingPlan(SmoothingPlan&&) noexcept;
  SmoothingPlan& operator=(SmoothingPlan&&) noexcept;
  ~SmoothingPlan();

  /// Smooths the points, one for every vertex, in place. Vertices that do not move keep their bits, the others are
  /// rounded to `storage`, or to float where the points are. The mesh lies in the plane of x and y: a third number of a
  /// point is its height, which stays as it is and must be the same for all vertices that cells use, to within 1e-6
  /// of their extent. The first call also orders the mesh in memory; a later one repeats that only if the majority
  /// orientation of a component has changed. Throws std::invalid_argument for a wrong number of points and for target
  /// lengths that do not fit, MeshError for a
  /// coordinate that is not finite and for heights that differ, DeviceError; the points are untouched then. Complexity:
  /// linear in each sweep and never more than the vertices whose neighbourhood changed; n log n in the first call.
  SmoothingResult smooth(const PointView& points, Storage storage = Storage::float64);

  /// Smooths a plain array of float or double: x and y of every vertex, 2 n numbers.
  template <array_layout::CoordinateNumbers R>
  SmoothingResult smooth(R&& xy, Storage storage = Storage::float64) {
    return smooth(xy_points(xy), storage);
  }
  /// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
  template <array_layout::OtherPoints R>
  SmoothingResult smooth(R&& /*points*/, Storage /*storage*/ = Storage::float64) {
    array_layout::refuse_points<R>();
    return {};
  }

  /// Why each vertex is held: bits of namespace hold (base/hold.h), 0 where nothing holds it. What is flat on purpose
  /// is known after the first smooth(). Throws std::logic_error where the plan has been moved from. Complexity: linear.
  [[nodiscard]] std::vector<std::uint8_t> fixed() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Makes a SmoothingPlan: `auto p = plan(n, triangles, constraints, options); p.smooth(points);`
SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const Constraints& constraints,
                   const SmoothingOptions& options = {});
/// Makes a SmoothingPlan without constraints: fixed is what the mesh itself holds.
SmoothingPlan plan(std::int64_t vertex_count, const IndexView& triangles, const SmoothingOptions& options = {});

/// Smooths the caller's points in place, once. For arguments, errors and guarantees see SmoothingPlan. What was done is
/// in the result, which nobody has to look at.
SmoothingResult smooth(const PointView& points, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options = {});
/// Smooths the caller's points in place, once, without constraints: fixed is what the mesh itself holds.
SmoothingResult smooth(const PointView& points, const IndexView& triangles, const SmoothingOptions& options = {});

/// A plain array does not say whether it holds x and y or x, y and z of a vertex: say xy_points(array) or
/// xyz_points(array).
template <array_layout::Numbers R>
SmoothingResult smooth(R&& xy_or_xyz, const IndexView& triangles, const Constraints& constraints,
                       const SmoothingOptions& options = {}) = delete;
template <array_layout::Numbers R>
SmoothingResult smooth(R&& xy_or_xyz, const IndexView& triangles, const SmoothingOptions& options = {}) = delete;

/// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
template <array_layout::OtherPoints R>
SmoothingResult smooth(R&& /*points*/, const IndexView& /*triangles*/, const Constraints& /*constraints*/,
                       const SmoothingOptions& /*options*/ = {}) {
  array_layout::refuse_points<R>();
  return {};
}
template <array_layout::OtherPoints R>
SmoothingResult smooth(R&& points, const IndexView& triangles, const SmoothingOptions& options = {}) {
  return smooth(points, triangles, Constraints{}, options);
}

/// Smooths the caller's mesh of quadratic triangles in place, once. `triangles`: six vertex numbers each, from 0: the
/// corners 0, 1 and 2, then the middles of the sides 01, 12 and 20, as VTK (type 22), Gmsh (type 9), Abaqus (CPS6) and
/// Nastran (CTRIA6) list them; listed in either direction. `points` has all nodes.
///
/// Corners are smoothed as smooth() does it with the triangles of corners. A middle then follows the ends of its
/// side: at the fraction s of it, which the input says, by (1 - s) times what one moves and s times what the other
/// does. Straight sides stay straight, middles at a quarter stay at a quarter, curved sides keep their bend, and a
/// middle whose ends stay keeps its bits, as on a curved boundary. Where that cannot be the middle stays and the ends
/// of its sides are held: a middle of two different sides, one that is a corner as well, one of
/// constraints.other_cells, or one that the constraints name. With options.guard every element that was valid by
/// jacobian_bound() (quadratic_triangle.h), which finds its smallest Jacobian in closed form, is so afterwards, and
/// none whose smallest Jacobian was 0 to rounding is invalid: the corners of one that would be go back, with the
/// middles of their sides.
///
/// `constraints` are those of smooth(); `regions` has one number a triangle of six nodes. The result counts corners
/// (moved_vertices) and says which went back; middles are in no count. Throws as SmoothingPlan does, the points are
/// untouched then: also std::invalid_argument unless there are six numbers for each triangle, or where vertices are to
/// slide, and MeshError for a middle that is none of the vertices. Complexity: that of smooth(), and linear beside it.
/// The middles and their guard are done on the host, whoever makes the sweeps, so the bits are the same for all
/// backends.
///
/// How valid the elements are is to be had of quadratic_quality() (quadratic_quality.h).
SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const Constraints& constraints, const SmoothingOptions& options = {});
/// Smooths a mesh of quadratic triangles without constraints: fixed is what the mesh itself holds.
SmoothingResult smooth_quadratic(const PointView& points, const ArrayView<std::int32_t>& triangles,
                                 const SmoothingOptions& options = {});

/// Smooths the caller's mesh of elements with nodes in the middle of their sides, and of others among them, in place,
/// once. `elements`: their nodes (see ElementNodes), in either direction. What smooth_quadratic() says of triangles of
/// six nodes holds of all: corners are smoothed as smooth() does it, middles of sides follow the ends, and what was
/// valid by jacobian_bound() (quadratic_quality.h) stays so. The node in the centre of a quadrilateral moves as the
/// place at its fraction between two opposite sides does, and keeps its bits where no corner moves; where it is named,
/// or a node of another element too, it stays and the corners are held. `regions` of the constraints has one number an
/// element. Throws as smooth_quadratic() of triangles does, MeshError for an element of another number of nodes.
/// Complexity: that of smooth(), and linear beside it.
SmoothingResult smooth_quadratic(const PointView& points, std::span<const ElementNodes> elements,
                                 const Constraints& constraints = {}, const SmoothingOptions& options = {});

}  // namespace trismooth
