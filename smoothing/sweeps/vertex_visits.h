#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/one_ring_update.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/sweeps/gathered_ring.h"
#include "trismooth/smoothing/sweeps/vertex_groups.h"

namespace trismooth {

/// Visits of a method to vertices whose rings are of one size, `lanes` of them at a time: here one.
template <class T, class Method>
class VertexVisits {
 public:
  static constexpr int lanes = 1;

  VertexVisits(const Method& method, const RingView& rings, std::span<const Point2<T>> points)
      : method_(method), rings_(rings), points_(points) {}

  /// Calls settle(v, move) for each vertex of the group.
  template <class Settle>
  void visit(const VertexGroup<lanes>& group, const Settle& settle) {
    const std::int32_t v = group.vertices[0];
    settle(v, gatherer_.with_ring(points_, rings_[v],
                                  [&](const auto& ring) { return update_over(method_, v, points_[v], ring); }));
  }

 private:
  const Method& method_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  RingGatherer<T> gatherer_;
};

}  // namespace trismooth
