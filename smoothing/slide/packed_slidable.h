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

  /// `input_index`: the number in the mesh of each packed vertex; `reversed`: as MeshRings::reversed. Complexity:
  /// linear.
  PackedSlidable(Slidable slidable, std::span<const std::uint8_t> reversed, std::span<const std::int32_t> input_index);

  bool any() const { return slidable_.any(); }

  /// The chains in packed numbers. `stored`: the vertices by their numbers in the mesh, in the caller's coordinates;
  /// `local`: the same packed, in the local frame. See find_slide_chains().
  SlideChains chains(std::span<const Point2<double>> stored, std::span<const Point2<double>> local, Storage storage,
                     const LocalFrame& frame) const;

 private:
  Slidable slidable_;
  std::vector<std::uint8_t> reversed_;  ///< of the triangles of slidable_
  std::vector<std::int32_t> numbers_;   ///< packed, of the vertices of slidable_
};

/// A vertex that has slid, and where it is to be stored, in the caller's coordinates.
struct SlidVertex {
  std::int32_t vertex;  ///< packed
  Point2<double> stored;
};

/// The vertices that are elsewhere on their chains, ascending. `places`: see SlidePass.
std::vector<SlidVertex> slid_vertices(const SlideChains& chains, std::span<const SlidePlace> places,
                                      const LocalFrame& frame, Storage storage);

}  // namespace trismooth
