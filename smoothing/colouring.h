#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/quality/workers.h"
#include "trismooth/smoothing/one_rings.h"

namespace trismooth {

/// The colours of Form B, one a vertex from 0; -1 for fixed vertices.
struct Colouring {
  std::vector<std::int32_t> colours;
  std::int32_t count = 0;   ///< colours used
  std::int32_t rounds = 0;  ///< dependent rounds that it took; varies with threads, the colours do not
};

/// Greedy colouring of the free vertices in the order of splitmix64(index): each gets the smallest colour that no
/// neighbour before it has. Vertices of one colour share no edge. In that order the dependences are short (under 20
/// rounds on meshes of millions of vertices), so it is done in parallel (Jones and Plassmann 1993); the colours are
/// those of the serial algorithm. `visit_order` lists the free vertices as memory is best walked.
Colouring colour_free_vertices(const OneRings& rings, std::span<const std::int32_t> visit_order, Workers& workers);

}  // namespace trismooth
