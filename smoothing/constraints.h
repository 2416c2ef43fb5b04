// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/base/array_view.h"
#include "trismooth/smoothing/sliding.h"

namespace trismooth {

/// What the caller holds fixed beside what the mesh itself does (boundaries, non-manifold and bow-tie vertices,
/// isolated vertices). All members are views, of anything contiguous (std::vector, std::array, std::span, ...), and may
/// be empty. The caller owns the memory and keeps it for as long as the Constraints are used; a function that takes
/// them does not look at it any more when it has returned. A temporary does not compile as a member.
struct Constraints {
  ArrayView<std::uint8_t> fixed{};        ///< one flag a vertex; not zero: fixed
  ArrayView<std::int32_t> fixed_ids{};    ///< vertex numbers from 0, in any order, also more than once
  ArrayView<std::uint8_t> other_cells{};  ///< one flag a vertex; not zero: used by a cell that is no element, fixed
  ArrayView<std::int32_t> regions{};      ///< one number an element; ends of edges between two regions are fixed
  Sliding slide{};                        ///< which of those that boundaries and interfaces hold move along them
};

/// Throws std::invalid_argument for a view of the wrong length, for the first vertex number out of range, and for an
/// angle or a deviation that is none. Complexity: linear in fixed_ids, lines and links.
void check_constraints(const Constraints& constraints, std::int32_t vertex_count, std::int64_t triangle_count);

}  // namespace trismooth
