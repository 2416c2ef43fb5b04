// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// An element around a vertex: the corners that sides from the vertex end at, in the order in which they are listed
/// behind it, and the one opposite of it.
struct ListedSide {
  std::int32_t first;
  std::int32_t second;
  std::int32_t opposite;  ///< no_corner in a triangle
  std::int32_t element;
};

/// What is around vertices that may slide, as far as connectivity says it: all that can be prepared before anybody
/// knows where they are. Numbers are those of the Slidable.
class SlidableFans {
 public:
  /// Nothing.
  SlidableFans() = default;
  /// `elements`: all around the vertices that may slide; `may_slide` and `is_free`: one flag a vertex; `numbers`: in
  /// the mesh, of each vertex. Complexity: linear, n log n in the vertices that may slide.
  SlidableFans(std::span<const MixedElement> elements, std::span<const std::uint8_t> may_slide,
               std::span<const std::uint8_t> is_free, std::span<const std::int32_t> numbers);

  /// The elements around a vertex that may slide: in an order that depends on the other corners alone, so that sums
  /// over them are the same in whatever order elements are listed.
  std::span<const ListedSide> around(std::int32_t vertex) const {
    const auto i = static_cast<std::size_t>(vertex);
    return std::span(sides_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }
  /// Of all vertices together.
  std::size_t side_count() const { return sides_.size(); }
  /// The vertices that may slide, in the order in which they are coloured: see coloured_before().
  std::span<const std::int32_t> colouring_order() const { return colouring_order_; }
  /// The elements without a free vertex.
  std::span<const std::int32_t> held_elements() const { return held_elements_; }
  /// Whether a vertex shares no element with a free one, as far as these elements tell.
  bool is_unknown(std::int32_t vertex) const { return is_unknown_[static_cast<std::size_t>(vertex)] != 0; }

 private:
  std::vector<std::size_t> begins_;
  std::vector<ListedSide> sides_;
  std::vector<std::int32_t> colouring_order_;
  std::vector<std::int32_t> held_elements_;
  std::vector<std::uint8_t> is_unknown_;  ///< one flag a vertex
};

}  // namespace trismooth
