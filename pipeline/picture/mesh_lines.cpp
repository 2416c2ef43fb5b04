// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/mesh_lines.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "trismooth/base/counting_sort.h"
#include "trismooth/base/machine/joined_blocks.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

namespace {

/// An edge as an element has it.
struct Side {
  std::int32_t low;  ///< its vertices
  std::int32_t high;
  std::int32_t region;
};

/// The edges between vertices that may be on a line, once for each of their elements.
std::vector<Side> sides_that_may_be(const MeshPicture& picture, Workers& workers) {
  constexpr std::int64_t grain = 16384;
  const std::span<const std::uint8_t> held = picture.held;
  return picture.elements.list().visit([&]<class Corners>(std::span<const Corners> elements) {
    return joined_lists<Side>(std::ssize(elements), grain, workers, [&](std::int64_t e, std::vector<Side>& sides) {
      const auto corners = static_cast<std::size_t>(corner_count(elements[e]));
      for (std::size_t i = 0; i < corners; ++i) {
        const std::int32_t from = elements[e][i];
        const std::int32_t to = elements[e][i + 1 < corners ? i + 1 : 0];
        if (from != to &&
            (held.empty() || (held[static_cast<std::size_t>(from)] != 0 && held[static_cast<std::size_t>(to)] != 0))) {
          sides.push_back({std::min(from, to), std::max(from, to), picture.regions.empty() ? 0 : picture.regions[e]});
        }
      }
    });
  });
}

/// By their vertices. Those of one vertex are few.
std::vector<Side> sorted(const std::vector<Side>& sides, std::size_t vertices, Workers& workers) {
  std::vector<Side> by_low(sides.size());
  const std::vector<std::int64_t> begins = counting_sort(
      std::ssize(sides), static_cast<std::int64_t>(vertices), [&](std::int64_t i) { return sides[i].low; },
      [&](std::int64_t i, std::int64_t place) { by_low[place] = sides[i]; }, workers);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(by_low.begin() + begins[v], by_low.begin() + begins[v + 1],
              [](const Side& a, const Side& b) { return a.high < b.high; });
  }
  return by_low;
}

}  // namespace

MeshLines mesh_lines(const MeshPicture& picture, int threads) {
  Workers workers(threads);
  const std::vector<Side> sides = sorted(sides_that_may_be(picture, workers), picture.before.size(), workers);
  MeshLines lines;
  std::size_t end = 0;
  for (std::size_t first = 0; first < sides.size(); first = end) {
    const Side& side = sides[first];
    for (end = first + 1; end < sides.size() && sides[end].low == side.low && sides[end].high == side.high;) {
      ++end;
    }
    if (end == first + 1) {
      lines.boundary.push_back({side.low, side.high});
    } else if (end > first + 2 || sides[first + 1].region != side.region) {
      lines.interfaces.push_back({side.low, side.high});
    }
  }
  return lines;
}

}  // namespace trismooth
