// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace trismooth {

struct RunState;

/// The mesh of a run, connected by halfedges.
class HalfedgeWay {
 public:
  HalfedgeWay() = default;
  HalfedgeWay(const HalfedgeWay&) = delete;
  HalfedgeWay& operator=(const HalfedgeWay&) = delete;
  virtual ~HalfedgeWay() = default;

  /// Runs the program's own stage (PipelineOptions::halfedge_stage). Answers one flag a point of the document that it
  /// holds, or none, and gives the run its arrays. Throws std::invalid_argument for flags and arrays that do not fit.
  virtual std::vector<std::uint8_t> run_stage(RunState& run) const = 0;
  /// What find_mesh_rings() finds, in every number, read from halfedges.
  virtual MeshRings rings(RunState& run, const Constraints& constraints, Layers layers) const = 0;
};

/// Whether this build has halfedges (TRISMOOTH_HALFEDGE). The mesh is smoothed to the same bits without.
bool has_halfedges();

/// Connects the elements of the run. Throws ReadError for what is no mesh; std::invalid_argument in a build that has
/// no halfedges.
std::unique_ptr<const HalfedgeWay> connect_by_halfedges(RunState& run);

}  // namespace trismooth
