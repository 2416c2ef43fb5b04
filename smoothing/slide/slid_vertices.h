// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/slide/slide_chains.h"

namespace trismooth {

/// A vertex that has slid, and where it is to be stored, in the caller's coordinates.
struct SlidVertex {
  std::int32_t vertex;  ///< as the chains number it
  Point2<double> stored;
};

/// The vertices that are elsewhere on their chains.
class SlidVertices {
 public:
  /// None.
  SlidVertices() = default;
  /// `places`: where the vertices are, by knot.
  SlidVertices(const SlideChains& chains, std::span<const SlidePlace> places, const LocalFrame& frame, Storage storage);

  auto begin() const { return slid_.begin(); }
  auto end() const { return slid_.end(); }

  /// What is known of a vertex; null: it has not slid. Complexity: the first time n log n, then log n: few are asked
  /// for, and mostly none.
  const SlidVertex* find(std::int32_t vertex);

 private:
  std::vector<SlidVertex> slid_;
  bool is_sorted_ = false;
};

}  // namespace trismooth
