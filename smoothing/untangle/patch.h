// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

/// A part of a mesh cut out to be solved by itself: vertices that may move, all elements around them, and the other
/// corners of these elements, which are held. Everything is numbered from 0 within the patch, the vertices that may
/// move first.
struct Patch {
  std::vector<std::int32_t> vertices;    ///< the number outside of each vertex
  std::int32_t free_count = 0;           ///< how many of them may move
  std::vector<MixedElement> elements;    ///< counter-clockwise, in canonical corner order
  std::vector<std::int64_t> offsets;     ///< of the vertices that may move, into the next three
  std::vector<std::int32_t> neighbours;  ///< in ring order
  std::vector<std::int32_t> opposites;   ///< as OneRings::opposites
  std::vector<std::int32_t> around;      ///< the element between a neighbour and the next one

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(vertices.size()); }
  std::int32_t element_count() const { return static_cast<std::int32_t>(elements.size()); }
  /// The rings of the vertices that may move.
  RingView rings() const { return {offsets, neighbours, {}, opposites}; }
  /// Per place in the ring of a vertex that may move: the element between the neighbour there and the next one.
  std::span<const std::int32_t> elements_around(std::int32_t vertex) const {
    return std::span(around).subspan(static_cast<std::size_t>(offsets[vertex]), rings()[vertex].size());
  }
};

/// Cuts patches out of one mesh. Keeps an array of the mesh's size, so it is made once.
class PatchCutter {
 public:
  /// `rings` must outlive the cutter.
  explicit PatchCutter(const RingView& rings, std::int32_t vertex_count);

  /// The patch in which `free` may move, free vertices of the mesh, each once. Its numbers follow from their order and
  /// that of their rings alone. Complexity: linear in the patch, times the size of a ring.
  Patch cut(std::span<const std::int32_t> free);

 private:
  /// Numbers the vertices and takes over the rings.
  void copy_rings(Patch& patch);

  const RingView& rings_;
  std::vector<std::int32_t> number_;  ///< in the patch of now; -1 elsewhere, and everywhere between two calls
};

}  // namespace trismooth
