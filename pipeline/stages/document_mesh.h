// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "trismooth/pipeline/stages/deform_stage.h"
#include "trismooth/pipeline/stages/run_state.h"
#include "trismooth/pipeline/stages/staged_mesh.h"

namespace trismooth {

/// A mesh that is a document of this process: what the stages of a run do with it (the other headers of this folder).
class DocumentMesh final : public StagedMesh {
 public:
  /// The options outlive it.
  explicit DocumentMesh(const PipelineOptions& options) : run_(options) {}

  /// What the stages have found.
  RunState& state() { return run_; }
  /// Has the mesh be that of the document, in place of reading one.
  void take(MeshDocument document);
  /// Has the mesh follow its boundary from now on (PipelineOptions::deformation). It is connected.
  Deformer& deform();
  /// Has the mesh be the other one (PipelineOptions::compared), and tells how they differ. It is connected and checked.
  void compare();

  RunContext& context() override { return run_; }
  void together(const std::function<void()>& work) const override { work(); }
  std::int64_t peak_memory() const override;
  void read() override;
  void connect() override;
  QualityOfMesh quality() override;
  PrecisionLoss precision_loss() override;
  CoarseBoundary coarse_boundary() override;
  /// Or has the mesh follow its boundary in the next step, when deform() has been called.
  SmoothingResult smooth() override;
  void keep_picture() override;
  void write(const std::function<const PipelineResult&()>& completed) override;

 private:
  RunState run_;
  std::unique_ptr<Deformer> deformer_;  ///< null: the boundary stays
  MeshDocument compared_;               ///< where meshes are compared
};

}  // namespace trismooth
