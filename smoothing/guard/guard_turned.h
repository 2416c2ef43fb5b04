#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "trismooth/smoothing/guard/guard_rounds.h"
#include "trismooth/smoothing/result.h"

namespace trismooth {

/// The mesh for the guard, where the components that `turned` says (see UntanglingResult) have been turned over.
using GuardedMeshOf = std::function<std::unique_ptr<GuardedMesh>(std::span<const std::uint8_t> turned)>;

/// guard_in_rounds() of a mesh that may have been untangled. A component that was turned over is as it was read or as
/// it was turned, nothing between: if one of its vertices goes back, all turned components do, and `untangling` says
/// so.
GuardOutcome guard_turned(std::int32_t vertex_count, std::span<const Triangle> elements,
                          std::optional<UntanglingResult>& untangling, const GuardedMeshOf& mesh_of, Workers& workers);

/// Triangles with a free vertex (0 in `fixed`) whose quotient, quotient_of(number), is not positive.
std::int64_t count_inverted(std::span<const Triangle> elements, std::span<const std::uint8_t> fixed,
                            const std::function<double(std::int32_t)>& quotient_of);

}  // namespace trismooth
