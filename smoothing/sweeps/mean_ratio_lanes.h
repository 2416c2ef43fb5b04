// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/rings/one_rings.h"
#include "trismooth/smoothing/sweeps/ring_lanes.h"
#include "trismooth/smoothing/sweeps/sides_in_lanes.h"
#include "trismooth/smoothing/sweeps/vertex_visits.h"

namespace trismooth {

/// Finds what the mean-ratio method says of the first `count` of `vertices`, whose rings are of one size and kind; the
/// others come next. The few that its energy alone does not decide are left undecided.
template <class T, bool shaped, bool is_last>
using MeanRatioLanes = void (*)(const MeanRatio<T, shaped, is_last>& method, const RingView& rings,
                                const Point2<T>* points, std::span<const std::int32_t> vertices, int count,
                                int ring_size, RingKind kind, LaneMoves<T>& found);

/// That by these instructions: the bits of the method's vertex_move().
template <class T, bool shaped, bool is_last>
MeanRatioLanes<T, shaped, is_last> mean_ratio_lanes(InstructionSet instructions);

/// Those of AVX2, where TRISMOOTH_HAS_AVX2_SOURCES is defined. (Functions of a template would be weak.)
void mean_ratio_lanes_avx2(MeanRatioLanes<float, false, false>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<float, false, true>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<float, true, false>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<float, true, true>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<double, false, false>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<double, false, true>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<double, true, false>& find);
void mean_ratio_lanes_avx2(MeanRatioLanes<double, true, true>& find);

template <class T, bool shaped, bool is_last>
class SideBySide<T, MeanRatio<T, shaped, is_last>> {
 public:
  using Method = MeanRatio<T, shaped, is_last>;

  SideBySide(const Method& method, const RingView& rings, std::span<const Point2<T>> points)
      : method_(method), rings_(rings), points_(points) {}

  static constexpr bool holds(int ring_size, RingKind kind) {
    return ring_size <= largest_ring_in_lanes && kind != RingKind::both;
  }

  const LaneMoves<T>& moves(std::span<const std::int32_t> vertices, int count, int ring_size, RingKind kind) {
    find_(method_, rings_, points_.data(), vertices, count, ring_size, kind, moves_);
    return moves_;
  }

 private:
  LaneMoves<T> moves_;
  const Method& method_;
  const RingView& rings_;
  std::span<const Point2<T>> points_;
  MeanRatioLanes<T, shaped, is_last> find_ = mean_ratio_lanes<T, shaped, is_last>(instruction_set());
};

}  // namespace trismooth
