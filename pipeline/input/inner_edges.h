// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// Counts what lies between triangles of different numbers. Numbers are given for every triangle.
class InnerEdges {
 public:
  /// `triangles` must outlive this; its corners are below `vertex_count`.
  InnerEdges(std::span<const Triangle> triangles, std::size_t vertex_count)
      : triangles_(triangles), vertex_count_(vertex_count) {}

  /// The vertices at which triangles of different numbers meet. Complexity: linear in the triangles; the first time in
  /// the vertices, too, of which a file may have many that no triangle uses.
  std::int64_t vertices_between(std::span<const std::int32_t> numbers);

  /// The fraction of the edges with exactly two triangles, 0 to 1, across which the number changes; 0 where there are
  /// no such edges. Complexity: linear, the first time n log n.
  double fraction_between(std::span<const std::int32_t> numbers);

 private:
  void label_used_vertices();

  std::span<const Triangle> triangles_;
  std::size_t vertex_count_;
  std::vector<Triangle> labelled_;  ///< the triangles with the used vertices numbered from 0; once they were asked for
  std::int32_t label_count_ = 0;
  std::optional<std::vector<std::array<std::int32_t, 2>>> neighbours_;  ///< the two triangles of each edge
};

}  // namespace trismooth
