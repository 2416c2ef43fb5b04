// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/triangle_view.h"
#include "trismooth/mpi/ascending_ids.h"
#include "trismooth/mpi/callers.h"
#include "trismooth/mpi/communicator.h"
#include "trismooth/mpi/local_mesh.h"
#include "trismooth/smoothing/constraints.h"
#include "trismooth/smoothing/parts/mesh_part.h"

namespace trismooth {

class Workers;

}

namespace trismooth::mpi {

/// The vertices that a rank owns, with all of their elements and these elements' other vertices, its ghosts: one layer,
/// which is what updates of own vertices need. Vertices are numbered in the order of their ids, elements in that of
/// theirs; so all that depends on the order of numbers in the whole mesh is found from those here.
struct Overlap {
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owners;  ///< ranks
  /// The elements. As MixedElement, on all ranks, where any rank has a quadrilateral.
  OwnElements listed;
  AscendingIds triangle_ids;          ///< one an element
  std::vector<std::int32_t> regions;  ///< one an element; empty: nobody has any
  /// One a vertex, bits hold::named and hold::other_cell; of ghosts 0.
  std::vector<std::uint8_t> named;
  MeshPart part;  ///< but for what colours are

  // Of constraints.slide, on the rank that owns all vertices.
  std::vector<std::int32_t> lines;
  std::vector<std::int32_t> line_tags;
  std::vector<std::int32_t> links;

  Callers callers;

  /// The elements, for as long as they are there. Local.
  ElementList elements() const { return listed.list(); }
  /// Whether this rank owns the first vertex of an element: one of the ranks that have it does. Local.
  bool counts(std::size_t element) const { return counts(elements()[element]); }
  /// Likewise, by its corners.
  bool counts(std::span<const std::int32_t> corners) const { return is_own(std::ranges::min(corners)); }
  /// Whether this rank owns a vertex of the overlap. Local.
  bool is_own(std::int32_t v) const { return part.ghosts[static_cast<std::size_t>(v)] == 0; }
  /// Vertices of the overlap, ghosts among them. Local.
  std::int32_t vertex_count() const { return static_cast<std::int32_t>(ids.size()); }
};

/// Whether any rank has a quadrilateral among `elements`. Collective. Complexity: linear.
bool has_quadrilaterals(const ElementList& elements, const Communicator& ranks);

/// What makes elements impossible to orient, for people. Local.
std::string_view why_one_sided(const Overlap& overlap);

/// Builds it from what all ranks have. `elements`: those of `mesh`. `is_gathered`: rank 0 owns all vertices, whatever
/// `mesh` says. Collective. Throws MeshError and std::invalid_argument on all ranks, for what is wrong on one of them
/// or between them: as SmoothingPlan does, and for ids that are negative or there twice, owners that are no ranks or
/// that ranks disagree about, and elements that two ranks have and none calls a ghost. Complexity: n log n in what the
/// rank has.
Overlap build_overlap(const LocalMesh& mesh, const ElementList& elements, const Constraints& constraints,
                      bool is_gathered, std::shared_ptr<const Communicator> communicator, Workers& workers);

/// build_overlap() of the elements that `mesh` has, on so many threads. Collective. Throws, and complexity, as with
/// elements that have been read.
Overlap build_overlap(const LocalMesh& mesh, const Constraints& constraints, bool is_gathered,
                      const std::shared_ptr<const Communicator>& communicator, int threads);

}  // namespace trismooth::mpi
