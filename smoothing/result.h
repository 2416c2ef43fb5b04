// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/base/enum_text.h"
#include "trismooth/base/point2.h"

namespace trismooth {

/// Why a smoothing ended.
enum class StopReason : std::uint8_t {
  fixed_point,     ///< no vertex moved in the last sweep
  tolerance,       ///< every move of the last sweep was within the tolerance
  few_moves,       ///< so few vertices still moved that next to nothing is left to gain (the mean-ratio method)
  sweep_limit,     ///< max_sweeps were done
  time_limit,      ///< the time was up
  quality_target,  ///< the smallest shape reached the target
  cancelled,       ///< the progress callback said stop, or `cancel` that nobody wants it any more
};

template <>
struct EnumText<StopReason> {
  static constexpr std::string_view what = "stop reason";
  static constexpr std::array<std::pair<StopReason, std::string_view>, 7> texts{
      {{StopReason::fixed_point, "fixed_point"},
       {StopReason::tolerance, "tolerance"},
       {StopReason::few_moves, "few_moves"},
       {StopReason::sweep_limit, "sweep_limit"},
       {StopReason::time_limit, "time_limit"},
       {StopReason::quality_target, "quality_target"},
       {StopReason::cancelled, "cancelled"}}};
};

/// What one sweep did.
struct SweepRecord {
  std::int64_t sweep = 0;        ///< from 1
  std::int64_t evaluated = 0;    ///< vertices whose update was computed
  std::int64_t moved = 0;        ///< vertices that moved
  double max_relative_move = 0;  ///< largest |move| / (root mean square distance to the neighbours)
  double min_shape = std::numeric_limits<double>::quiet_NaN();  ///< after the sweep; NaN where it was not asked for
};

/// A vertex that the guard took back, and where it had been moved to: by the sweeps, or by the untangling before them.
/// The guard takes it back to its place in the input, or where a mesh has been untangled to where that left it, if this
/// is enough.
struct RevertedVertex {
  std::int32_t vertex = 0;    ///< its number
  Point2<double> position{};  ///< in the caller's coordinates
};

/// Milliseconds of the parts of one call.
struct SmoothingTimings {
  double prepare = 0;       ///< renumbering, colouring, packing; next to nothing where an earlier call has done it
  double transfer_in = 0;   ///< to the device
  double untangle = 0;      ///< before the sweeps
  double smooth = 0;        ///< the sweeps
  double transfer_out = 0;  ///< from the device
  double commit = 0;        ///< the never-worse guard
};

/// What the untangling before the sweeps did. Elements are counted that are inverted or degenerate.
struct UntanglingResult {
  std::int64_t inverted_before = 0;     ///< with a free vertex, in the input
  std::int64_t inverted_untangled = 0;  ///< of these, after the untangling: never more
  std::int64_t inverted_after = 0;      ///< with a free vertex, in the result
  std::int64_t inverted_fixed = 0;      ///< without a free vertex: nothing can mend them
  /// Components whose free vertices were so tangled that the wrong triangles were in the majority: they have been
  /// turned over, so that what was valid in them is inverted and the other way round. `inverted_before` counts what it
  /// was before that.
  std::int32_t turned_components = 0;
  std::vector<std::uint8_t> turned{};  ///< one byte an element, 1 where it is of these components; empty: there is none
};

/// Whether nobody stopped it: no caller, no clock.
constexpr bool ran_to_its_end(StopReason reason) {
  return reason != StopReason::cancelled && reason != StopReason::time_limit;
}

/// What became of vertices that may slide along boundaries and interfaces.
struct SlidingResult {
  std::int64_t chains = 0;        ///< those linked with each other count once
  std::int64_t vertices = 0;      ///< that may slide
  std::int64_t slid = 0;          ///< that did
  double largest_deviation = 0;   ///< between the old lines and the new ones, in the units of the coordinates
  double relative_deviation = 0;  ///< the largest, as a part of the length of the edge nearby: see Sliding::deviation
  /// Vertices that would slide but for others that lie in the same place, or within a thousandth of an edge of it, and
  /// with which they do not slide as one: see Sliding::coincident.
  std::int64_t in_same_place = 0;
  /// Vertices that would slide but for an edge of another line within which they lie without being its ends, and the
  /// ends of these edges.
  std::int64_t at_edges = 0;
  /// So many vertices would have gone back for what slid that all was smoothed once more without sliding: this is what
  /// came of that.
  bool given_up = false;
};

/// What was found of triangles that are flat in one direction, at least four times as long as high: see Layers. The
/// aspect of a triangle is the root of the ratio of the eigenvalues of its edge tensor; infinite without area.
struct LayersResult {
  std::int64_t kept = 0;           ///< vertices that are held for that and for nothing else
  std::int64_t kept_on_lines = 0;  ///< where vertices slide: those on boundaries and interfaces that do not for that
  double kept_aspect = 0;          ///< the largest aspect of the triangles around them; 0: there is none
  std::int64_t left = 0;  ///< vertices inside of stretches that are flat in one direction and are smoothed all the same
  double left_aspect = 0;  ///< the largest aspect of their triangles; 0: there is none
};

/// What a smoothing did. The coordinates themselves are in the caller's arrays.
struct SmoothingResult {
  std::int64_t sweeps = 0;  ///< the last one, in which nothing moved, included
  StopReason stop_reason = StopReason::fixed_point;
  std::int64_t vertex_updates = 0;     ///< evaluations over all sweeps
  std::int64_t moved_vertices = 0;     ///< vertices whose stored coordinates differ from the input's
  std::int64_t reverted_vertices = 0;  ///< vertices that the guard took back
  std::int64_t guard_rounds = 0;       ///< rounds of the guard that took vertices back
  std::int64_t free_vertices = 0;      ///< vertices that nothing holds fixed, nor to a line
  std::int64_t quadrilaterals = 0;     ///< among the elements
  /// Nodes between the corners of quadratic elements that are corners as well, in the middle of several sides or the
  /// centre of several elements: nothing can follow there, so they are held, with the corners around them.
  std::int64_t shared_middles = 0;
  /// Elements that are inverted in the result, and those without area (quadrilaterals: with a corner in line): of all,
  /// with a free vertex or not, each as its component is oriented; of six nodes the corners. With the guard none that
  /// was valid is among them; where nothing is untangled (`untangling` is empty) sweeps mend some of the input's and
  /// leave others. Both are -1 where nobody has counted them: the call was over before the first sweep, so that nothing
  /// has moved, and all else that it had not found out by then is 0 or empty.
  std::int64_t inverted = 0;
  std::int64_t degenerate = 0;
  std::int32_t colours = 0;                    ///< of Form B; 0 for Form A
  std::vector<SweepRecord> history;            ///< one record a sweep
  std::vector<RevertedVertex> reverted;        ///< ascending by vertex
  std::optional<UntanglingResult> untangling;  ///< where untangling was asked for
  std::optional<SlidingResult> sliding;        ///< where sliding was asked for
  LayersResult layers;                         ///< nothing with Layers::smooth
  std::string backend;                         ///< "cpu", "cuda"
  std::string device;                          ///< the processor or GPU by name
  int threads = 0;                             ///< of the CPU; 0 where a device made the sweeps
  std::int64_t kernel_launches = 0;            ///< on a device, by the host: sweeps and guard
  std::int64_t child_launches = 0;             ///< on a device, by the device (dynamic parallelism)
  std::int64_t device_memory_bytes = 0;        ///< the most that was allocated on the device at a time
  bool reproducible = true;                    ///< false for Order::unordered
  std::string backend_note;  ///< why a backend was chosen that the caller may not have expected, or empty
  SmoothingTimings timings;
};

}  // namespace trismooth
