// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;
struct MeshPart;

/// Packed vertices in turn whose rings are of one size and one kind.
struct RingRun {
  std::int32_t end;  ///< behind the last of them; the first is where the run before ends
  std::int32_t ring_size;
  RingKind kind;

  friend bool operator==(const RingRun&, const RingRun&) = default;
};

/// One-rings renumbered for the sweeps: free vertices first, grouped into batches whose vertices may be updated at the
/// same time (Form A: one batch; Form B: one a colour), each batch along a Hilbert curve; fixed vertices last. Within
/// windows of the curve vertices are sorted by ring size and kind, so that the loops over rings are predictable.
///
/// Those of a part of a mesh (MeshPart) have two batches in place of one: the vertices that other parts have as ghosts,
/// then the others.
struct PackedRings {
  BulkVector<std::int32_t> input_index;  ///< the caller's number of each packed vertex
  BulkVector<std::int64_t> offsets;      ///< ring of packed free vertex v: neighbours[offsets[v] .. offsets[v + 1])
  BulkVector<std::int32_t> neighbours;   ///< packed numbers, in ring order
  BulkVector<std::int32_t> opposites;    ///< packed numbers, as OneRings::opposites
  std::vector<RingRun> runs;             ///< of the free vertices, as long as may be
  std::vector<std::int32_t> batches{0};  ///< batch b holds packed vertices batches[b] .. batches[b + 1]
  std::int32_t colours = 0;              ///< 0 for Form A
  std::int32_t free_ghosts = 0;          ///< vertices behind the free ones that other parts of the mesh move

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(input_index.size()); }
  std::int32_t free_count() const { return batches.back(); }
  /// Vertices from here on are fixed.
  std::int32_t first_fixed() const { return free_count() + free_ghosts; }
  RingView view() const { return {offsets, neighbours, input_index, opposites}; }
};

/// `rings`: released on the way, so move them here where they are not needed any more. `points`: the caller's vertices
/// in the local frame; used for the order alone. `part`: where they are those of a part of a mesh; its ghosts have no
/// rings. Complexity: linear.
PackedRings pack_rings(OneRings rings, std::span<const Point2<double>> points, Form form, Workers& workers,
                       const MeshPart* part = nullptr);

}  // namespace trismooth
