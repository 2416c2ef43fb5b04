// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/inner_edges.h"

#include <algorithm>
#include <utility>

namespace trismooth {

namespace {

std::vector<std::array<std::int32_t, 2>> find_neighbours(std::span<const Triangle> triangles) {
  struct Side {
    std::int32_t low, high, triangle;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t)});
    }
  }
  std::ranges::sort(sides);
  std::vector<std::array<std::int32_t, 2>> neighbours;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin == 2) {
      neighbours.push_back({sides[begin].triangle, sides[begin + 1].triangle});
    }
  }
  return neighbours;
}

}  // namespace

void InnerEdges::label_used_vertices() {
  constexpr std::int32_t unused = -1;
  std::vector<std::int32_t> labels(vertex_count_, unused);
  labelled_.assign(triangles_.begin(), triangles_.end());
  for (Triangle& triangle : labelled_) {
    for (std::int32_t& v : triangle) {
      std::int32_t& label = labels[v];
      label = label == unused ? label_count_++ : label;
      v = label;
    }
  }
}

std::int64_t InnerEdges::vertices_between(std::span<const std::int32_t> numbers) {
  constexpr std::int32_t unseen = -1;
  constexpr std::int32_t several = -2;
  if (labelled_.empty()) {
    label_used_vertices();
  }
  std::vector<std::int32_t> seen(static_cast<std::size_t>(label_count_), unseen);
  std::int64_t count = 0;
  for (std::size_t t = 0; t < labelled_.size(); ++t) {
    for (const std::int32_t v : labelled_[t]) {
      std::int32_t& number = seen[v];
      if (number == unseen) {
        number = numbers[t];
      } else if (number != several && number != numbers[t]) {
        number = several;
        ++count;
      }
    }
  }
  return count;
}

double InnerEdges::fraction_between(std::span<const std::int32_t> numbers) {
  if (!neighbours_) {
    neighbours_ = find_neighbours(triangles_);
  }
  const auto changes =
      std::ranges::count_if(*neighbours_, [&](const auto& pair) { return numbers[pair[0]] != numbers[pair[1]]; });
  return neighbours_->empty() ? 0 : static_cast<double>(changes) / static_cast<double>(neighbours_->size());
}

}  // namespace trismooth
