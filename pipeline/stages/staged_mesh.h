// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "trismooth/pipeline/pipeline.h"
#include "trismooth/quality/coarse_boundary.h"
#include "trismooth/quality/precision_loss.h"

namespace trismooth {

struct RunContext;

/// How good a mesh is, of the whole of it.
struct QualityOfMesh {
  QualityReport report;
  std::vector<RegionQuality> regions;         ///< empty where there are no two
  std::optional<QuadraticQuality> quadratic;  ///< where there are quadratic elements
};

/// The mesh of a run, of which its stages ask what they do with it and say of it (StagedRun). It is there as a whole
/// (DocumentMesh), or each rank of a job has pieces of it (pipeline/ranks/piece_run.h): then all functions are
/// collective, what they answer is of the whole mesh and the same on all ranks, and so is what they throw.
class StagedMesh {
 public:
  StagedMesh() = default;
  StagedMesh(const StagedMesh&) = delete;
  StagedMesh& operator=(const StagedMesh&) = delete;
  virtual ~StagedMesh() = default;

  /// What the run has, and what comes of it.
  virtual RunContext& context() = 0;
  /// Calls what one of those who run may throw at, and has all of them throw it.
  virtual void together(const std::function<void()>& work) const = 0;
  /// The most memory that a process has taken, in bytes.
  virtual std::int64_t peak_memory() const = 0;

  /// Reads the input.
  virtual void read() = 0;
  /// Finds what the mesh means and how it hangs together, and summarises that (summarise_mesh()).
  virtual void connect() = 0;
  /// The quality of the mesh as it is now.
  virtual QualityOfMesh quality() = 0;
  /// What single precision would lose of it.
  virtual PrecisionLoss precision_loss() = 0;
  /// Where its boundary is too coarse for what is behind it.
  virtual CoarseBoundary coarse_boundary() = 0;
  /// Smooths it, and has all that belongs to it follow. Throws Cancelled.
  virtual SmoothingResult smooth() = 0;
  /// Keeps in the result what pictures show of the mesh as it is now, behind what was kept before its smoothing.
  virtual void keep_picture() {}
  /// Writes it: when all is complete under other names `completed` gives the result, which is told on
  /// (PipelineOptions::beside), and then all takes its place. There is an output.
  virtual void write(const std::function<const PipelineResult&()>& completed) = 0;

 protected:
  /// Throws Cancelled where sweeps were.
  void stop_if_cancelled(const SmoothingResult& smoothing) const {
    together([&smoothing] {
      if (smoothing.stop_reason == StopReason::cancelled) {
        throw Cancelled();
      }
    });
  }
};

}  // namespace trismooth
