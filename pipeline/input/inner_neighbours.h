#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/triangle_view.h"

namespace trismooth {

/// The neighbours of the vertices that are asked for.
class InnerNeighbours {
 public:
  /// Of the vertices whose flag in `wanted` is 1.
  InnerNeighbours(std::span<const Triangle> triangles, std::span<const std::uint8_t> wanted)
      : starts_(wanted.size() + 1, 0), ends_(wanted.size(), 0) {
    const auto is_wanted = [wanted](std::int32_t v) { return wanted[static_cast<std::size_t>(v)] != 0; };
    for (const Triangle& triangle : triangles) {
      for (const std::int32_t v : triangle) {
        starts_[static_cast<std::size_t>(v) + 1] += is_wanted(v) ? 2 : 0;
      }
    }
    for (std::size_t v = 0; v < wanted.size(); ++v) {
      starts_[v + 1] += starts_[v];
      ends_[v] = starts_[v];
    }
    neighbours_.resize(static_cast<std::size_t>(starts_.back()));
    for (const auto& [a, b, c] : triangles) {
      for (const auto& [v, left, right] : {Triangle{a, b, c}, Triangle{b, c, a}, Triangle{c, a, b}}) {
        if (is_wanted(v)) {
          std::int64_t& end = ends_[static_cast<std::size_t>(v)];
          neighbours_[static_cast<std::size_t>(end++)] = left;
          neighbours_[static_cast<std::size_t>(end++)] = right;
        }
      }
    }
    for (std::size_t v = 0; v < wanted.size(); ++v) {
      keep_inner(v);
    }
  }

  /// The neighbours of a wanted vertex, each once; none where it is not inside the mesh.
  std::span<const std::int32_t> operator[](std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(neighbours_)
        .subspan(static_cast<std::size_t>(starts_[v]), static_cast<std::size_t>(ends_[v] - starts_[v]));
  }

 private:
  /// Keeps one of the two times that each neighbour is there; nothing where one is there another number of times.
  void keep_inner(std::size_t v) {
    const auto begin = neighbours_.begin() + starts_[v];
    const auto end = neighbours_.begin() + ends_[v];
    std::sort(begin, end);
    auto kept = begin;
    ends_[v] = starts_[v];
    for (auto next = begin; next != end; next += 2) {
      if (*next != *(next + 1) || (kept != begin && *(kept - 1) == *next)) {
        return;
      }
      *kept++ = *next;
    }
    ends_[v] += kept - begin;
  }

  std::vector<std::int64_t> starts_;
  std::vector<std::int64_t> ends_;
  std::vector<std::int32_t> neighbours_;
};

}  // namespace trismooth
