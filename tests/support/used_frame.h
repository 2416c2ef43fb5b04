// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/triangle_view.h"

namespace test_meshes {

/// The local frame of a mesh, as the contract says it: that of the vertices which cells use, as if there were no
/// others.
inline trismooth::LocalFrame used_frame(std::span<const trismooth::Point2<double>> points,
                                        std::span<const trismooth::Triangle> triangles,
                                        std::span<const std::uint8_t> other_cells = {}) {
  std::vector<bool> is_used(points.size(), false);
  for (const trismooth::Triangle& t : triangles) {
    for (const std::int32_t v : t) {
      is_used[static_cast<std::size_t>(v)] = true;
    }
  }
  std::vector<trismooth::Point2<double>> used;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_used[v] || (!other_cells.empty() && other_cells[v] != 0)) {
      used.push_back(points[v]);
    }
  }
  return trismooth::local_frame(used);
}

}  // namespace test_meshes
