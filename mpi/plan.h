// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include <mpi.h>

#include "trismooth/base/point_view.h"
#include "trismooth/base/storage.h"
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/mpi/traffic.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"

namespace trismooth::mpi {

/// What becomes of what cannot be done in pieces.
enum class Gather : std::uint8_t {
  never,        ///< it is refused by std::invalid_argument, on all ranks
  where_needed  ///< rank 0 does it alone, with the whole mesh in its memory; the bits are the same
};

/// A mesh in pieces, one a rank, whose connectivity is analysed once and whose coordinates are smoothed as often as
/// they change. The bits are those that SmoothingPlan gives the whole mesh, whose vertices and triangles have these ids
/// for numbers (where ids are missing, they are vertices of no triangle), for every number of ranks and every way of
/// cutting: every vertex is moved by the rank that owns it, and what the others see of it are its values. Nothing is
/// held of the whole mesh on any rank, unless Gather allows it. What is said of triangles holds for quadrilaterals.
///
/// Functions are collective over the ranks of the communicator, but for those that say otherwise: all ranks call them
/// in the same order. An error on one of them is thrown on all of them, of the same type, with the rank's number in
/// front; coordinates of all ranks are untouched then. MPI is called on the thread that calls (MPI_THREAD_FUNNELED will
/// do), on a copy of the communicator. What cannot be told to the others any more (no memory left in the middle of a
/// sweep, a message that MPI fails to deliver) ends them all, by MPI_Abort().
///
/// Methods, forms, precisions, constraints, regions, target lengths and the guard are those of SmoothingPlan. Sliding
/// (Constraints::slide), and untangling of a mesh that has inverted triangles (without any,
/// SmoothingOptions::untangles() changes nothing), are not there in pieces: Gather says what becomes of that. With the
/// CUDA backend a device makes the sweeps of each rank, that of the rank's place on its machine; all else is done by
/// the CPU. The paper's executions and orders are refused by
/// std::invalid_argument.
class [[nodiscard]] Plan {
 public:
  /// `communicator`: a copy of it is made; the caller's may be freed. `mesh` and `constraints`: in the rank's own
  /// numbers; a vertex is held where any rank that has it says so. A rank may have nothing. `options`: the same on all
  /// ranks, but for threads (0: an equal share of the cores of the machine for each rank on it), target lengths and
  /// progress, whose "stop" from any rank stops all. Throws as SmoothingPlan does, and std::invalid_argument for ids
  /// that are negative or twice on a rank, owners that are no ranks or that ranks disagree about, triangles that two
  /// ranks have and none calls a ghost, options that differ; std::logic_error where MPI is not initialised. Complexity:
  /// n log n in what the rank has. Collective.
  Plan(MPI_Comm communicator, const LocalMesh& mesh, const Constraints& constraints,
       const SmoothingOptions& options = {}, Gather gather = Gather::never);
  /// A plan without constraints: all else as above. Collective.
  Plan(MPI_Comm communicator, const LocalMesh& mesh, const SmoothingOptions& options = {},
       Gather gather = Gather::never);
  Plan(Plan&&) noexcept;
  Plan& operator=(Plan&&) noexcept;
  /// Collective. After MPI_Finalize() it frees memory alone.
  ~Plan();

  /// Smooths the local points in place, one for each local vertex, copies of other ranks' vertices included: these must
  /// be the same to the bit on all ranks that have them, and are so afterwards. Arguments and errors are those of
  /// SmoothingPlan::smooth(). Of the result, `reverted` lists the local vertices that went back, on every rank that has
  /// them, UntanglingResult::turned is not filled, and processor, threads and timings are the rank's; all else is of
  /// the whole mesh, the same on all ranks. Where the mesh is gathered (see Gather), rank 0's progress callback alone
  /// is called. Collective.
  SmoothingResult smooth(const PointView& points, Storage storage = Storage::float64);

  /// Smooths the points of a plain array of float or double: x and y of every local vertex. Collective.
  template <array_layout::CoordinateNumbers R>
  SmoothingResult smooth(R&& xy, Storage storage = Storage::float64) {
    return smooth(xy_points(xy), storage);
  }

  /// What this rank has sent while it smoothed, since the plan was made. Throws std::logic_error where the plan was
  /// moved from. Local.
  [[nodiscard]] Traffic traffic() const;
  /// Vertices that this rank owns. Throws std::logic_error where the plan was moved from. Local.
  [[nodiscard]] std::int64_t own_vertices() const;
  /// Vertices of others that it holds a copy of. Throws std::logic_error where the plan was moved from. Local.
  [[nodiscard]] std::int64_t ghost_vertices() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trismooth::mpi
