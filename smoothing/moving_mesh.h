// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "trismooth/base/array_layout.h"
#include "trismooth/base/enum_text.h"
#include "trismooth/base/index_view.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/follow_result.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// Where the free vertices of a mesh that moves are carried on from.
enum class MovingStart : std::uint8_t {
  reference,  ///< the mesh as it was made: the result depends on the boundary alone
  previous,   ///< the last result: less is to be done where steps are small, and the result depends on the path
};

template <>
struct EnumText<MovingStart> {
  static constexpr std::string_view what = "start";
  static constexpr std::array<std::pair<MovingStart, std::string_view>, 2> texts{
      {{MovingStart::reference, "reference"}, {MovingStart::previous, "previous"}}};
};

/// The options that MovingMesh has by default: Method::mean_ratio with the shapes and sizes of the reference as
/// targets. The power of the energy is 8, for the worst element counts most where a mesh is deformed, and sizes weigh
/// less than in a mesh that stays (found by experiment: docs/moving.md).
[[nodiscard]] SmoothingOptions moving_options();

/// A mesh that follows its boundary, as in ALE methods: rotors, flapping foils, free surfaces. Made of the mesh at
/// rest, the reference, whose shapes and sizes are the targets. In each step the caller says where the held vertices
/// are; the free ones are carried along, untangled where they have to be, smoothed towards the targets, and guarded:
///
///     trismooth::MovingMesh moving(points, triangles);
///     for (...) {
///       move_boundary(points);                  // of the held vertices
///       auto result = moving.follow(points);    // all are where they belong
///       if (!result.is_valid()) { ... }         // the boundary leaves the mesh no room
///     }
///
/// Options are best made from moving_options(): those of SmoothingOptions itself have a method without a memory of the
/// reference. With MovingStart::reference the result is a function of the reference and the boundary alone: the same
/// boundary gives the same bits, whatever came before, so after a cycle the drift is 0. Where nothing has moved the
/// result is near the reference, not it: shapes that it has are better where that does nobody harm.
///
/// Vertices of layers (SmoothingOptions::layers, found in the reference) are carried along and not smoothed: their
/// heights stay. Owns copies of all it needs. Can be moved; what was moved from can be assigned to and destroyed, its
/// functions throw std::logic_error. One thread at a time may use it; follow(), take_back() and go_on_from() throw
/// std::logic_error in a callback of its own follow().
class [[nodiscard]] MovingMesh {
 public:
  /// `reference`: one point for every vertex, in the plane of x and y. `triangles`: elements, quadrilaterals among them
  /// where four numbers are listed for each; those, and `constraints`: as SmoothingPlan has them; no vertices slide.
  /// Throws MeshError and std::invalid_argument as SmoothingPlan does, and MeshError for a coordinate that is not
  /// finite; std::invalid_argument also for sliding, for options.mean_ratio.target_lengths (sizes are those of the
  /// reference) and for a backend of several devices; DeviceError; PlanCancelled. Complexity: linear, but for sorting
  /// the edges of each vertex.
  MovingMesh(const ConstPointView& reference, const IndexView& triangles, const Constraints& constraints,
             const SmoothingOptions& options = moving_options());
  /// Held is what the mesh itself holds: its boundaries.
  MovingMesh(const ConstPointView& reference, const IndexView& triangles,
             const SmoothingOptions& options = moving_options());
  /// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
  template <array_layout::OtherPoints R, class... More>
  explicit MovingMesh(const R& /*reference*/, const More&... /*more*/) {
    array_layout::refuse_points<R>();
  }
  MovingMesh(MovingMesh&&) noexcept;
  MovingMesh& operator=(MovingMesh&&) noexcept;
  ~MovingMesh();

  /// Puts the free vertices to where they belong, in place. `points`: one for every vertex; those of held vertices are
  /// where they are now, and keep their bits; those of free ones are not looked at, but must be finite. Of three
  /// numbers a point has, the third stays as it is, and those of held vertices that cells use are one height
  /// (MeshError). Free vertices are rounded to the type of the points, and to `storage`. Throws std::invalid_argument
  /// for a wrong number of points and MeshError for a coordinate that is not finite; the points are untouched then, as
  /// where options.cancel ends the call before the first sweep or options.time_limit_seconds does
  /// (StopReason::cancelled, time_limit): what carries the vertices along is not broken off for want of time. The
  /// result knows nothing of the mesh then (`inverted` is -1, shapes are NaN) but the crossings of the boundary.
  /// Complexity: two linear systems, each linear in each of some ten steps, and that of SmoothingPlan::smooth().
  FollowResult follow(const PointView& points, MovingStart start = MovingStart::reference,
                      Storage storage = Storage::float64);

  /// Has the last step not have happened, as where a solver repeats a time step with a smaller one: the last result is
  /// again the one before it. Throws std::logic_error where there is no such step: none yet, one that was taken back,
  /// go_on_from() since, or a call since that has begun and has not come to its end (its limits ended it before the
  /// first sweep, a callback has thrown): it has not happened, but what was before the step before it is gone.
  /// Complexity: constant.
  void take_back();

  /// Has these points be the last result, as where a run goes on that was broken off: MovingStart::previous starts
  /// there, and largest_move counts from there. `points`: one for every vertex. Throws std::invalid_argument for a
  /// wrong number of points, MeshError for a coordinate that is not finite; nothing has changed then. Complexity:
  /// linear.
  void go_on_from(const ConstPointView& points);

  /// Points of a type that does not say where their numbers are: what to write instead is in the compiler's message.
  template <array_layout::OtherPoints R>
  FollowResult follow(R&& /*points*/, MovingStart /*start*/ = MovingStart::reference,
                      Storage /*storage*/ = Storage::float64) {
    array_layout::refuse_points<R>();
    return {};
  }

  /// Why each vertex is held, bits of namespace hold (base/hold.h), 0 where nothing holds it; layers are not among
  /// them: their vertices are carried along. The caller says where those are that have other bits. Throws
  /// std::logic_error where it has been moved from. Complexity: linear.
  [[nodiscard]] std::vector<std::uint8_t> held() const;

  /// The last result, one point for every vertex; at first the reference. Throws std::logic_error where it has been
  /// moved from. Complexity: linear.
  [[nodiscard]] std::vector<Point2<double>> points() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trismooth
