// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"
#include "trismooth/smoothing/rings/slidable.h"
#include "trismooth/smoothing/slide/slide_chains.h"

namespace trismooth {

/// What may slide in a mesh that has been renumbered for the sweeps.
class PackedSlidable {
 public:
  /// Nothing.
  PackedSlidable() = default;

  /// `reversed`: as MeshRings::reversed, of the Slidable's elements; `numbers`: packed, of its vertices.
  PackedSlidable(Slidable slidable, std::span<const std::uint8_t> reversed, std::vector<std::int32_t> numbers);

  bool any() const { return slidable_.any(); }
  const Slidable& slidable() const { return slidable_; }
  std::span<const std::int32_t> numbers() const { return numbers_; }
  /// Around those that may slide, corners in packed numbers.
  const SlideElements& packed_elements() const { return packed_elements_; }

  /// The chains, with the vertices' numbers in the Slidable: see find_slide_chains(). They view what this owns.
  /// `stored`: these vertices, in the caller's coordinates.
  SlideChains chains(std::span<const Point2<double>> stored, Storage storage, const LocalFrame& frame) const;

 private:
  Slidable slidable_;
  SlideElements elements_;
  std::vector<std::int32_t> numbers_;
  SlideElements packed_elements_;
};

/// The packed numbers of a Slidable's vertices. `input_index`: the number in the mesh of each packed vertex.
/// Complexity: linear in these.
std::vector<std::int32_t> packed_numbers(const Slidable& slidable, std::span<const std::int32_t> input_index);

}  // namespace trismooth
