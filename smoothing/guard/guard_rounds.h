#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/triangle_view.h"
#include "trismooth/smoothing/guard/never_worse.h"

namespace trismooth {

class Workers;

/// A mesh whose moved vertices the guard may put back: what its rounds ask of it.
class GuardedMesh {
 public:
  GuardedMesh() = default;
  GuardedMesh(const GuardedMesh&) = delete;
  GuardedMesh& operator=(const GuardedMesh&) = delete;
  virtual ~GuardedMesh() = default;

  /// Whether the vertex is elsewhere than it was.
  virtual bool has_moved(std::int32_t vertex) const = 0;
  /// The element's quotient as it was (see guard_rule.h). From any thread.
  virtual double quotient_before(std::int32_t element) const = 0;
  /// The quotient that the element was brought down to, as worsened_quotient(); infinity where none of its vertices is
  /// elsewhere. It depends on the element's corners alone. From any thread.
  virtual double worsened(std::int32_t element) const = 0;
  /// Brings the vertex back to where it was.
  virtual void put_back(std::int32_t vertex) = 0;
};

/// The rounds of keep_never_worse() for a mesh that evaluates its elements itself. `elements` are their corners.
/// Complexity: linear in the vertices and elements, and m log m in the m elements around moved vertices.
GuardOutcome guard_in_rounds(std::int32_t vertex_count, std::span<const Triangle> elements, GuardedMesh& mesh,
                             Workers& workers);

}  // namespace trismooth
