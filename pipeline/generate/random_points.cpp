// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/generate/random_points.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

namespace trismooth {

namespace {

GridPoint random_point(std::int32_t lowest, std::int32_t end, std::mt19937_64& generator) {
  const int bits = std::bit_width(static_cast<std::uint32_t>(end - 1));
  const auto is_outside = [&](std::int32_t coordinate) { return coordinate < lowest || coordinate >= end; };
  GridPoint point{};
  do {
    const std::uint64_t draw = generator();
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    point = {static_cast<std::int32_t>(draw >> (64 - bits)), static_cast<std::int32_t>((draw >> 4) & mask)};
  } while (is_outside(point[0]) || is_outside(point[1]));
  return point;
}

/// The indices of points that equal one of a lower index, ascending.
std::vector<std::int32_t> repeated_points(const std::vector<GridPoint>& points) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted[i] = {static_cast<std::uint64_t>(points[i][0]) << 32 | static_cast<std::uint64_t>(points[i][1]),
                 static_cast<std::int32_t>(i)};
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> repeated;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) {
      repeated.push_back(sorted[i].second);
    }
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

}  // namespace

std::uint64_t random_below(std::uint64_t bound, std::mt19937_64& generator) {
  const std::uint64_t largest = bound - 1;
  const int unused_bits = std::countl_zero(largest | 1U);
  for (;;) {
    const std::uint64_t draw = generator() >> unused_bits;
    if (draw <= largest) {
      return draw;
    }
  }
}

std::vector<std::int32_t> random_permutation(std::int32_t count, std::mt19937_64& generator) {
  std::vector<std::int32_t> permutation(static_cast<std::size_t>(count));
  std::iota(permutation.begin(), permutation.end(), 0);
  for (std::size_t left = permutation.size(); left > 1; --left) {
    std::swap(permutation[left - 1], permutation[random_below(left, generator)]);
  }
  return permutation;
}

std::vector<GridPoint> random_points(std::int64_t count, std::int32_t lowest, std::int32_t end,
                                     std::mt19937_64& generator) {
  std::vector<GridPoint> points(static_cast<std::size_t>(count));
  for (GridPoint& point : points) {
    point = random_point(lowest, end, generator);
  }
  for (auto repeated = repeated_points(points); !repeated.empty(); repeated = repeated_points(points)) {
    for (const std::int32_t index : repeated) {
      points[index] = random_point(lowest, end, generator);
    }
  }
  return points;
}

}  // namespace trismooth
