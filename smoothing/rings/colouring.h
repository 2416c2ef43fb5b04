// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;

/// The colours of Form B.
struct Colouring {
  BulkVector<std::int32_t> colours;  ///< one a vertex of the view, from 0; -1 for those without a ring
  std::int32_t count = 0;            ///< colours used
};

/// Greedy colouring of the free vertices in the order of splitmix64(input index): each gets the smallest colour that no
/// other vertex of its elements before it has. Vertices of one colour share no element. In that order the dependences
/// are short as a rule, so it is done in parallel (Jones and Plassmann 1993), and where they are long, serially; the
/// colours are those of the serial algorithm, whatever the numbering of the view and the number of threads.
/// Complexity: linear, n log n where the dependences are long.
Colouring colour_free_vertices(const RingView& rings, Workers& workers);

/// The serial algorithm for the rest: colours the free vertices whose colour is -1 in the order of splitmix64(input
/// index). One colour a vertex of the view; those that come before an uncoloured neighbour have theirs already.
/// Complexity: a scan of `colours`, and n log n in the vertices that are left and their neighbours.
void colour_the_rest(const RingView& rings, std::span<std::int32_t> colours);

/// What a part of a mesh can colour before other parts say more: those of `waiting` whose neighbours before them, in
/// the order of splitmix64(id), have colours or get them here; they are taken out of it. `rings`: of all that the part
/// colours itself, in its own numbering; `ids`, `is_free` and `colours` are of these vertices and of the ghosts, which
/// may get their colours between two calls; -1: none. Complexity: linear, as a rule, in what is waiting.
void colour_ready(const RingView& rings, std::span<const std::int64_t> ids, std::span<const std::uint8_t> is_free,
                  std::span<std::int32_t> colours, BulkVector<std::int32_t>& waiting, Workers& workers);

}  // namespace trismooth
