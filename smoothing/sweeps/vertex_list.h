// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

#include "trismooth/smoothing/rings/packed_rings.h"

namespace trismooth {

/// The vertices of a block that a sweep evaluates, a list at a time: the marked ones, whose marks are taken away, or
/// all.
class VertexList {
 public:
  VertexList(std::span<std::uint8_t> marked, bool all, std::int32_t begin, std::int32_t end)
      : marked_(marked), all_(all), next_(begin), end_(end) {}

  /// The next vertices, in their order. Empty: there are no more.
  std::span<const std::int32_t> next() {
    count_ = 0;
    while (count_ == 0 && next_ < end_) {
      if (all_) {
        take_all();
      } else {
        take_marked();
      }
    }
    return std::span(vertices_).first(static_cast<std::size_t>(count_));
  }

 private:
  static constexpr std::int32_t enough = 1024;
  static constexpr std::int32_t word = 8;  // marks that are looked at together

  void take_all() {
    count_ = std::min(enough, end_ - next_);
    std::iota(vertices_.begin(), vertices_.begin() + count_, next_);
    next_ += count_;
  }

  void take_marked() {
    const std::int32_t begin = next_;
    for (; next_ + word <= end_ && count_ < enough; next_ += word) {
      std::array<std::uint8_t, word> eight{};
      std::memcpy(eight.data(), &marked_[static_cast<std::size_t>(next_)], word);
      if (std::bit_cast<std::uint64_t>(eight) != 0) {
        take(eight);
      }
    }
    for (; next_ < end_ && count_ < enough; ++next_) {
      take_if(marked_[next_] != 0, next_);
    }
    std::memset(&marked_[static_cast<std::size_t>(begin)], 0, static_cast<std::size_t>(next_ - begin));
  }

  void take(const std::array<std::uint8_t, word>& marks) {
    for (std::int32_t i = 0; i < word; ++i) {
      take_if(marks[i] != 0, next_ + i);
    }
  }

  /// Without a branch, which would be guessed wrong too often.
  void take_if(bool is_marked, std::int32_t vertex) {
    vertices_[count_] = vertex;
    count_ += is_marked ? 1 : 0;
  }

  std::span<std::uint8_t> marked_;
  bool all_;
  std::int32_t next_;
  std::int32_t end_;
  std::int32_t count_ = 0;
  std::array<std::int32_t, enough + word> vertices_;
};

/// Calls visit(vertices, ring_size, kind) for those of `vertices`, which ascend, that are of one run. `runs`: see
/// PackedRings.
template <class Visit>
void for_runs_of_one_size(std::span<const RingRun> runs, std::span<const std::int32_t> vertices, const Visit& visit) {
  if (vertices.empty()) {
    return;
  }
  for (auto run = std::ranges::upper_bound(runs, vertices.front(), {}, &RingRun::end); !vertices.empty(); ++run) {
    const auto count = static_cast<std::size_t>(std::ranges::lower_bound(vertices, run->end) - vertices.begin());
    if (count > 0) {
      visit(vertices.first(count), run->ring_size, run->kind);
    }
    vertices = vertices.subspan(count);
  }
}

}  // namespace trismooth
