// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/splitmix64.h"

namespace trismooth {

/// Numbers few of a large range from 0, in their order: an open hash table, for which a sort and searches would take
/// several times as long.
class NumberPlaces {
 public:
  static constexpr std::int32_t none = -1;

  /// `numbers`: any that are not negative, also more than once. Complexity: linear, n log n in those that differ.
  explicit NumberPlaces(std::span<const std::int32_t> numbers)
      : slots_(std::bit_ceil(2 * numbers.size() + 1)), mask_(slots_.size() - 1) {
    for (const std::int32_t number : numbers) {
      Slot& slot = slots_[slot_of(number)];
      if (slot.number == none) {
        slot.number = number;
        sorted_.push_back(number);
      }
    }
    std::ranges::sort(sorted_);
    for (std::size_t place = 0; place < sorted_.size(); ++place) {
      slots_[slot_of(sorted_[place])].place = static_cast<std::int32_t>(place);
    }
  }

  /// The numbers, ascending, each once.
  std::span<const std::int32_t> sorted() const { return sorted_; }
  /// The place of a number among them; none where it is not there.
  std::int32_t of(std::int32_t number) const { return slots_[slot_of(number)].place; }

 private:
  struct Slot {
    std::int32_t number = none;
    std::int32_t place = none;
  };

  /// Its own slot, or the empty one where it would be.
  std::size_t slot_of(std::int32_t number) const {
    std::size_t slot = splitmix64(static_cast<std::uint64_t>(number)) & mask_;
    while (slots_[slot].number != number && slots_[slot].number != none) {
      slot = (slot + 1) & mask_;
    }
    return slot;
  }

  std::vector<Slot> slots_;  ///< a power of two of them, at most half of them taken
  std::size_t mask_;
  std::vector<std::int32_t> sorted_;
};

}  // namespace trismooth
