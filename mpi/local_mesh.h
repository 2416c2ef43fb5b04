// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "trismooth/base/array_view.h"
#include "trismooth/base/index_view.h"

namespace trismooth::mpi {

/// What a rank without elements has of them.
inline const std::vector<std::int32_t> no_triangles;

/// What a rank has of a mesh, which may be nothing. All views; the caller keeps the memory until the function returns
/// that takes them. What is said of triangles holds for quadrilaterals, too: ids count elements of either kind.
struct LocalMesh {
  /// Three numbers of local vertices each, from 0, listed in either direction; or four where quadrilaterals are among
  /// them, corners in turn, of which the last is then -1 for a triangle. Ranks need not list them alike.
  IndexView triangles{no_triangles};
  /// One for each local vertex: its number in the whole mesh, from 0, the same on every rank that has it. Results
  /// depend on them as those of smooth() do on the numbers of vertices. Those that are not there are vertices of no
  /// triangle: ids from 1 give another result than ids from 0.
  ArrayView<std::int64_t> vertex_ids{};
  /// One for each local vertex: the rank that moves it, whether or not it has the vertex itself. Ranks agree on it.
  /// Empty on all ranks: the lowest rank that has the vertex.
  ArrayView<std::int32_t> owners{};
  /// One flag for each local triangle; not zero: a copy of one that another rank has, which is left out. Empty: there
  /// are none. A plan builds the ghosts it needs itself, so nobody has to have any.
  ArrayView<std::uint8_t> ghost_triangles{};
  /// One for each local triangle: its number in the whole mesh, from 0, of each but copies once. Empty on all ranks:
  /// those of rank 0 come first, then those of rank 1, ... They matter to a component in which as many triangles are
  /// listed one way as the other.
  ArrayView<std::int64_t> triangle_ids{};
};

}  // namespace trismooth::mpi
