// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <exception>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/component_labels.h"
#include "trismooth/mpi/ghost_values.h"
#include "trismooth/mpi/overlap.h"
#include "trismooth/mpi/plan.h"
#include "trismooth/mpi/plan_points.h"
#include "trismooth/mpi/traffic.h"
#include "trismooth/smoothing/backend.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/slidable.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth::mpi {

/// Smooths the meshes whose overlap it has: what a Plan is once its overlap is built. Functions throw as Plan's do, as
/// KnownToAll.
class OverlapSmoother {
 public:
  /// Whether rank 0 owns all vertices, and smooths alone.
  enum class Owners : std::uint8_t { ranks, first };

  /// `options`: see agreed_options(); their backend takes quadrilaterals in parts, where the overlap has any. `slide`:
  /// what Constraints::slide was where rank 0 owns all; lines and links are the overlap's. `note`: what the user is to
  /// know of the backend. Collective.
  OverlapSmoother(std::shared_ptr<const Communicator> communicator, Overlap overlap, const SmoothingOptions& options,
                  Sliding slide, Gather gather, Owners owners, std::string note = {});
  OverlapSmoother(const OverlapSmoother&) = delete;
  OverlapSmoother& operator=(const OverlapSmoother&) = delete;
  ~OverlapSmoother() = default;

  /// As Plan::smooth(). Collective.
  SmoothingResult smooth(const PointView& points, Storage storage);

  /// The ranks. Local.
  const Communicator& communicator() const { return *communicator_; }
  /// What this rank has sent so far. Local.
  Traffic traffic() const;
  /// Vertices that this rank owns. Local.
  std::int64_t own_vertices() const;
  /// Vertices of others that it holds a copy of. Local.
  std::int64_t ghost_vertices() const { return std::ssize(overlap_.ids) - own_vertices(); }

  /// Gives the overlap back, but for its owners, and is of no more use. Local.
  Overlap take_overlap();

 private:
  const TriangleComponents& components() const { return topology_ ? *topology_ : components_; }
  /// How many quadrilaterals the whole mesh has. Collective.
  void count_quadrilaterals();
  /// How many vertices are free in the whole mesh. Collective.
  void count_free();
  /// Holds layers, and finds what may slide beside them. Collective.
  void find_layers(std::span<const Point2<double>> local, std::span<const std::uint8_t> reversed);
  /// Prepares the sweeps where the orientation that these points give the mesh is new. Collective.
  void make_ready(const LocalFrame& frame, std::span<const Point2<double>> mine);
  /// Colours the free vertices as colour_free_vertices() does it in the whole mesh.
  void colour(const OneRings& rings);
  /// The caller's options for the rank's own numbers; an exception of a callback stops all ranks.
  SmoothingOptions used_options();
  SmoothingResult smoothed(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame);
  SmoothingResult smoothed_in_pieces(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame);
  /// By rank 0, which has all.
  SmoothingResult smoothed_here(std::span<Point2<double>> mine, Storage stored, const LocalFrame& frame);
  /// By rank 0, where that was not known before: it gets all then.
  SmoothingResult smoothed_gathered(std::span<Point2<double>> mine, Storage stored);
  /// Why the call is over, if it is on any rank. Collective.
  std::optional<CallEnd> agreed_end(CallLimit& limit) const;
  /// Throws on all ranks what a callback has thrown on one. Collective.
  void rethrow_from_callbacks();

  std::shared_ptr<const Communicator> communicator_;
  SmoothingOptions options_;
  Sliding slide_;  ///< its lists are not looked at: the overlap has them
  Gather gather_;
  bool is_gathered_;  ///< rank 0 owns all vertices
  std::string note_;
  std::optional<Workers> workers_;
  bool has_lengths_ = false;  ///< some rank has target lengths
  Overlap overlap_;
  std::int64_t quadrilaterals_ = 0;  ///< in the whole mesh
  std::optional<GhostValues> ghosts_;
  std::optional<PlanPoints> points_;
  std::optional<TriangleTopology> topology_;  ///< of the overlap, until rings are made of it
  TriangleComponents components_;             ///< what is left of it then
  std::vector<std::uint8_t> fixed_;           ///< as MeshRings::fixed, ghosts as their owners have it
  LayersResult layers_;
  bool has_found_layers_ = false;
  Slidable slidable_;  ///< where it is gathered
  ComponentLabels labels_;
  bool is_coloured_ = false;
  bool is_ready_ = false;  ///< for sweeps with `reversed_`
  std::vector<std::uint8_t> reversed_;
  std::vector<double> lengths_;  ///< that are asked for, of the overlap; empty: none
  std::unique_ptr<PreparedSmoother> smoother_;
  std::exception_ptr callback_error_;
  std::unique_ptr<OverlapSmoother> gathered_;  ///< of what cannot be done in pieces, where it was needed
};

/// The options as they are used on a rank, its threads counted. Throws on all ranks what Plan's constructor throws for
/// options, and for a backend that is not ready. Collective.
SmoothingOptions agreed_options(const SmoothingOptions& options, const Constraints& constraints, Gather gather,
                                const Communicator& ranks);

/// Builds the overlap of what all ranks have, and its smoother, as Plan's constructor is described. Collective.
std::unique_ptr<OverlapSmoother> make_overlap_smoother(std::shared_ptr<const Communicator> communicator,
                                                       const LocalMesh& mesh, const Constraints& constraints,
                                                       const SmoothingOptions& options, Gather gather,
                                                       OverlapSmoother::Owners owners);

}  // namespace trismooth::mpi
