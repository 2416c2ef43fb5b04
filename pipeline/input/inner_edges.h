// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// Counts what lies between elements of different numbers. Numbers are given for every element.
class InnerEdges {
 public:
  /// `elements` must outlive this; their corners are below `vertex_count`.
  InnerEdges(const ElementList& elements, std::size_t vertex_count)
      : elements_(elements), vertex_count_(vertex_count) {}

  /// The vertices at which elements of different numbers meet. Complexity: linear in the elements; the first time in
  /// the vertices, too, of which a file may have many that no element uses.
  std::int64_t vertices_between(std::span<const std::int32_t> numbers);

  /// The fraction of the edges with exactly two elements, 0 to 1, across which the number changes; 0 where there are
  /// no such edges. Complexity: linear, the first time n log n.
  double fraction_between(std::span<const std::int32_t> numbers);

 private:
  void label_used_vertices();

  ElementList elements_;
  std::size_t vertex_count_;
  /// The corners of all elements with the used vertices numbered from 0; once they were asked for.
  std::vector<std::int32_t> labelled_;
  std::int32_t label_count_ = 0;
  std::optional<std::vector<std::array<std::int32_t, 2>>> neighbours_;  ///< the two elements of each edge
};

}  // namespace trismooth
