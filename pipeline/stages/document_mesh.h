#pragma once

#include <functional>

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

  RunContext& context() override { return run_; }
  void together(const std::function<void()>& work) const override { work(); }
  std::int64_t peak_memory() const override;
  void read() override;
  void connect() override;
  MeshQuality quality() override;
  PrecisionLoss precision_loss() override;
  CoarseBoundary coarse_boundary() override;
  SmoothingResult smooth() override;
  void write(const std::function<const PipelineResult&()>& completed) override;

 private:
  RunState run_;
};

}  // namespace trismooth
