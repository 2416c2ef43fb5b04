// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/pipeline/input/displacements.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/smoothing/moving_mesh.h"

namespace trismooth {

/// The mesh of a run as it follows its boundary, by the steps of PipelineOptions::deformation.
class Deformer {
 public:
  /// `run` is connected, and outlives it. Throws ReadError and std::invalid_argument for a mesh that cannot follow.
  explicit Deformer(RunState& run);

  /// Has the mesh follow in the next step: the points of the run are those of the result then. Throws as
  /// find_displacements(), ReadError where the boundary leaves the plane of the mesh.
  SmoothingResult follow();

  /// Keeps what the run has found out of the step when the mesh has been checked. After the last step the result of the
  /// run tells of the worst one, and what is to be warned of is said.
  void step_checked();

  /// The number of steps done.
  std::size_t done() const { return done_; }
  bool is_done() const { return done_ == run_.options.deformation->step_count(); }
  /// Where the mesh of the last step done goes.
  std::filesystem::path output() const;

 private:
  /// The file that has the displacements of a step, for people.
  const std::filesystem::path& file_of_step(std::size_t step) const;
  /// Puts the boundary to where it is in the next step.
  void move_boundary();
  /// Has the free vertices follow.
  void move_inside();
  /// Stores a vertex that goes to that place.
  void store(std::size_t vertex, Point2<double> place);

  RunState& run_;
  std::vector<double> file_points_;         ///< as they were read
  BulkVector<Point2<double>> file_places_;  ///< in the plane
  LocalPoints file_local_;
  std::vector<Obeys> obeys_;
  std::vector<MixedElement> valid_quads_;  ///< that are held, and valid in the file
  std::ptrdiff_t folded_quads_ = 0;        ///< of these, in the step that folds most
  std::vector<std::string> said_;          ///< of files of displacements
  std::vector<std::uint8_t> is_told_;      ///< a byte a vertex: the step says where it goes
  MovingMesh moving_;
  FollowResult followed_;  ///< of the last step
  std::size_t done_ = 0;
  DeformationResult steps_;
  PipelineResult worst_;  ///< as of the worst step so far
};

}  // namespace trismooth
