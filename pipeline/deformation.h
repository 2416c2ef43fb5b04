// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trismooth/quality/quadratic_quality.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/moving_mesh.h"

namespace trismooth {

/// Where the boundary of a mesh goes, in a run in which the mesh follows it (smoothing/moving_mesh.h). Displacements
/// are vectors of two or three numbers in the file's unit, from where the mesh's file has its vertices, in every step;
/// those of the vertices that are held are obeyed.
struct Deformation {
  /// The point array of the displacements, in the mesh's own file or in those of `steps`. Empty: there is none.
  std::string array;
  /// A file for each step: a mesh that has the array, on the same boundary, or a text (.csv, .txt) of lines `vertex,
  /// dx, dy` or `vertex, dx, dy, dz`. Empty: one step, by the array of the mesh's own file.
  std::vector<std::filesystem::path> steps;
  /// Numbers of vertices in texts are those that the mesh's own file gives its points, in place of rows from 0.
  bool labels = false;
  /// Each step has a mesh of its own: see output_of_step(). Else there is one step.
  bool is_series = false;
  MovingStart start = MovingStart::reference;  ///< where each step starts

  /// One where there are no files of steps. O(1).
  std::size_t step_count() const { return steps.empty() ? 1 : steps.size(); }
};

/// The file of a step (from 0) of a series: the number of the step, from 1, is put behind the stem of `output`, with
/// zeros in front so that names sort: "out.vtu" is "out_007.vtu" in the seventh step of a hundred, "out.vtk.gz"
/// "out_007.vtk.gz".
std::filesystem::path output_of_step(const std::filesystem::path& output, std::size_t step, std::size_t count);

/// How a mesh followed its boundary in one step.
struct DeformedStep {
  std::filesystem::path displacements;             ///< the file they were taken from
  std::filesystem::path output;                    ///< what was written
  QualityReport quality;                           ///< of the result, as PipelineResult::after
  std::optional<QuadraticQuality> quadratic;       ///< as PipelineResult::quadratic_after
  double min_relative_shape = 0;                   ///< see FollowResult
  double mean_relative_shape = 0;                  ///< see FollowResult
  std::int64_t invalid_held = 0;                   ///< see FollowResult
  std::int64_t crossings = 0;                      ///< pairs of edges; FollowResult::most_listed: that many or more
  std::int64_t overlaps = 0;                       ///< vertices; FollowResult::most_listed: that many or more
  double largest_displacement = 0;                 ///< of a vertex from where the mesh's file has it, in its unit
  std::int64_t sweeps = 0;                         ///< of the smoothing
  StopReason stop_reason = StopReason::tolerance;  ///< of the sweeps
  std::uint64_t coordinates_hash = 0;              ///< see PipelineResult

  /// Triangles that are inverted or degenerate.
  std::int64_t invalid() const { return quality.inverted + quality.degenerate; }
  /// Triangles of six nodes that are not valid, by their corners or their sides.
  std::int64_t invalid_quadratic() const { return quadratic ? quadratic->invalid : 0; }
  /// Whether the mesh is worse than in that other step: more triangles that are inverted or degenerate, else more of
  /// six nodes that are not valid, else a smaller shape.
  bool is_worse_than(const DeformedStep& other) const;
};

/// How a mesh followed its boundary, step by step.
struct DeformationResult {
  std::vector<DeformedStep> steps;
  std::size_t worst = 0;  ///< the step that the rest of the run's result tells of
};

}  // namespace trismooth
