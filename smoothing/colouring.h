#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/quality/workers.h"
#include "trismooth/smoothing/one_rings.h"

namespace trismooth {

/// The colours of Form B.
struct Colouring {
  std::vector<std::int32_t> colours;  ///< one a vertex of the view, from 0; -1 for those without a ring
  std::int32_t count = 0;             ///< colours used
};

/// Greedy colouring of the free vertices in the order of splitmix64(input index): each gets the smallest colour that no
/// neighbour before it has. Vertices of one colour share no edge. In that order the dependences are short (under 20
/// rounds on meshes of millions of vertices), so it is done in parallel (Jones and Plassmann 1993); the colours are
/// those of the serial algorithm, whatever the numbering of the view and the number of threads.
Colouring colour_free_vertices(const RingView& rings, Workers& workers);

}  // namespace trismooth
