// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <mpi.h>

#include "trismooth/base/point2.h"
#include "trismooth/base/point_view.h"
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/moving_mesh.h"
#include "trismooth/smoothing/options.h"

namespace trismooth::mpi {

/// trismooth::MovingMesh of a mesh in pieces, one a rank, to the bits of the whole mesh, whose vertices and triangles
/// have these ids for numbers, for every number of ranks and every way of cutting. The linear systems that carry the
/// mesh along are not solved in pieces: rank 0 has the whole mesh in its memory and makes the steps, with its share of
/// the machine's cores or, with the CUDA backend, its device; positions of all vertices come to it and go back, and the
/// others wait. An error on one rank is thrown on all of them, of the same type, with the rank's number in front;
/// coordinates of all ranks are untouched then. MPI is called on the thread that calls, on a copy of the communicator.
/// Can be moved; what was moved from can be assigned to and destroyed, its functions throw std::logic_error.
class [[nodiscard]] MovingMesh {
 public:
  /// `communicator`: a copy of it is made; the caller's may be freed. `reference`: one point for each local vertex, the
  /// same to the bit on all ranks that have it, in the units of the mesh; `mesh`, `constraints`: in the rank's own
  /// numbers; a vertex is held where any rank that has it says so; no vertices slide. All are copied. A rank may have
  /// nothing. `options`: the same on all ranks, but for threads and `progress` and `cancel`, of which those of rank 0
  /// alone are called. Throws as trismooth::MovingMesh and mpi::Plan do, and std::invalid_argument for ids above
  /// 2^31 - 2. Complexity: n log n in what a rank has, linear in the largest id on rank 0. Collective.
  MovingMesh(MPI_Comm communicator, const ConstPointView& reference, const LocalMesh& mesh,
             const Constraints& constraints, const SmoothingOptions& options = moving_options());
  /// Held is what the mesh itself holds: its boundaries. All else as with constraints. Collective.
  MovingMesh(MPI_Comm communicator, const ConstPointView& reference, const LocalMesh& mesh,
             const SmoothingOptions& options = moving_options());
  MovingMesh(MovingMesh&&) noexcept;
  MovingMesh& operator=(MovingMesh&&) noexcept;
  /// Collective. After MPI_Finalize() it frees memory alone.
  ~MovingMesh();

  /// Puts the free vertices to where they belong, in place. `points`: one for each local vertex, of two or three
  /// numbers, float or double, alike on all ranks that have vertices; those of held vertices are where they are now,
  /// the same to the bit on all ranks that have them, and keep their bits; those of free ones are not looked at, but
  /// must be finite and the same, too. `start`: the same on all ranks. Throws std::invalid_argument for a wrong number
  /// of points and for what ranks disagree about, MeshError for a coordinate that is not finite and for held vertices
  /// of several heights; DeviceError. The result is that of the whole mesh, on all ranks: `crossings`, `overlaps` and
  /// `invalid` have the ids of vertices and triangles; `reverted` lists local vertices, on every rank that has them;
  /// UntanglingResult::turned is not filled; device, threads, launches and timings are rank 0's, and are 0 or empty on
  /// the others. Complexity: that of trismooth::MovingMesh::follow() of the whole, on rank 0. Collective.
  FollowResult follow(const PointView& points, MovingStart start = MovingStart::reference);

  /// Has the last step not have happened: see trismooth::MovingMesh::take_back(), and throws as that, on all ranks.
  /// Complexity: constant. Collective.
  void take_back();

  /// Has these points be the last result: see trismooth::MovingMesh::go_on_from(). `points`: one for each local vertex,
  /// as for follow(). Throws std::invalid_argument for a wrong number of points and for points that ranks disagree
  /// about, MeshError for a coordinate that is not finite; nothing has changed then. Complexity: linear. Collective.
  void go_on_from(const ConstPointView& points);

  /// Why each local vertex is held, bits of namespace hold (base/hold.h), 0 where nothing holds it. Throws
  /// std::logic_error where it has been moved from. Complexity: linear. Local.
  [[nodiscard]] std::vector<std::uint8_t> held() const;

  /// The last result, one point for each local vertex; at first the reference. Throws std::logic_error where it has
  /// been moved from. Complexity: linear in the whole mesh, on rank 0. Collective.
  [[nodiscard]] std::vector<Point2<double>> points() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trismooth::mpi
