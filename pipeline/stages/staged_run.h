// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/pipeline/pipeline.h"
#include "trismooth/pipeline/stages/run_context.h"
#include "trismooth/pipeline/stages/staged_mesh.h"

namespace trismooth {

/// The one run that there is, whoever has the mesh: the stages in their order, each with its time, and what is said
/// between them. What it finds is in the context of the mesh. All functions throw what those of the mesh throw, and
/// Cancelled where the options' callback says so.
class StagedRun {
 public:
  /// The mesh outlives it. Throws std::invalid_argument for options of which none is a matter of the mesh.
  explicit StagedRun(StagedMesh& mesh);

  void read();
  /// All stages between reading and writing.
  void check_and_smooth();
  /// Those up to the smoothing.
  void check();
  /// The smoothing, and the check behind it.
  void smooth();
  /// Has `take_place` put another mesh of the same elements in the place of the one that has been checked, and checks
  /// that.
  void compare(const std::function<void()>& take_place);
  /// Writes the mesh, where there is an output, and what belongs to it. Completes the result.
  void write();
  /// The times and the memory of the whole run.
  void complete();
  /// Says that a stage begins.
  void begin(Stage stage) const;
  /// Since it was made.
  double milliseconds() const { return watch_.milliseconds(); }

 private:
  template <class Body>
  void timed(Stage stage, double& milliseconds, const Body& body) const;
  void check_before();
  void keep_picture();
  void check_after();

  const Stopwatch watch_;
  StagedMesh& mesh_;
  RunContext& run_;
};

}  // namespace trismooth
