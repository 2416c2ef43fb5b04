// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/input/inner_edges.h"

#include <algorithm>

namespace trismooth {

namespace {

std::vector<std::array<std::int32_t, 2>> find_neighbours(const ElementList& elements) {
  struct Side {
    std::int32_t low, high, element;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve((elements.are_triangles() ? 3 : 4) * elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto corners = elements[e];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax({corners[i], next_corner(corners, i)});
      sides.push_back({low, high, static_cast<std::int32_t>(e)});
    }
  }
  std::ranges::sort(sides);
  std::vector<std::array<std::int32_t, 2>> neighbours;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin == 2) {
      neighbours.push_back({sides[begin].element, sides[begin + 1].element});
    }
  }
  return neighbours;
}

}  // namespace

void InnerEdges::label_used_vertices() {
  constexpr std::int32_t unused = -1;
  std::vector<std::int32_t> labels(vertex_count_, unused);
  labelled_.reserve((elements_.are_triangles() ? 3 : 4) * elements_.size());
  for (const auto corners : elements_) {
    for (const std::int32_t v : corners) {
      std::int32_t& label = labels[v];
      label = label == unused ? label_count_++ : label;
      labelled_.push_back(label);
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
  auto label = labelled_.begin();
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (std::size_t corner = 0; corner < elements_[e].size(); ++corner) {
      std::int32_t& number = seen[*label++];
      if (number == unseen) {
        number = numbers[e];
      } else if (number != several && number != numbers[e]) {
        number = several;
        ++count;
      }
    }
  }
  return count;
}

double InnerEdges::fraction_between(std::span<const std::int32_t> numbers) {
  if (!neighbours_) {
    neighbours_ = find_neighbours(elements_);
  }
  const auto changes =
      std::ranges::count_if(*neighbours_, [&](const auto& pair) { return numbers[pair[0]] != numbers[pair[1]]; });
  return neighbours_->empty() ? 0 : static_cast<double>(changes) / static_cast<double>(neighbours_->size());
}

}  // namespace trismooth
