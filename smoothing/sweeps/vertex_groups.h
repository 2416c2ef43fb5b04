#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

/// Vertices to be visited together: their rings are of one size.
template <int lanes>
struct VertexGroup {
  std::array<std::int32_t, lanes> vertices;  ///< where there are fewer, the first again
  int count = 0;                             ///< 0: none are left
};

/// The marked vertices of [begin, end), or all of them, in groups. Who visits a group may clear its marks.
template <int lanes>
class VertexGroups {
 public:
  VertexGroups(const RingView& rings, std::span<const std::uint8_t> marked, bool all, std::int32_t begin,
               std::int32_t end)
      : rings_(rings), marked_(marked), all_(all), next_(first_from(begin, end)), end_(end) {}

  VertexGroup<lanes> next() {
    VertexGroup<lanes> group;
    if (next_ == end_) {
      return group;
    }
    group.vertices.fill(next_);
    const std::size_t size = rings_[next_].size();
    do {
      group.vertices[group.count++] = next_;
      next_ = first_from(next_ + 1, end_);
    } while (group.count < lanes && next_ < end_ && rings_[next_].size() == size);
    return group;
  }

 private:
  /// The first one of [v, end), or end; marks are looked at eight at a time where none is set.
  std::int32_t first_from(std::int32_t v, std::int32_t end) const {
    if (all_) {
      return v;
    }
    std::uint64_t eight = 0;
    while (v + 8 <= end) {
      std::memcpy(&eight, marked_.data() + v, sizeof(eight));
      if (eight != 0) {
        break;
      }
      v += 8;
    }
    while (v < end && marked_[v] == 0) {
      ++v;
    }
    return v;
  }

  RingView rings_;
  std::span<const std::uint8_t> marked_;
  bool all_;
  std::int32_t next_;
  std::int32_t end_;
};

}  // namespace trismooth
