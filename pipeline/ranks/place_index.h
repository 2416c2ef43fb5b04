// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trismooth {

/// Finds numbers in an ascending list of different ones: where they are spread about evenly it reads two or three
/// places of memory, not one for each halving of the list.
class PlaceIndex {
 public:
  /// The numbers outlive it. Complexity: linear; memory of 4 bytes for every 8 numbers. Local.
  explicit PlaceIndex(std::span<const std::int64_t> numbers) : numbers_(numbers) {
    if (numbers.empty()) {
      return;
    }
    const auto range = static_cast<std::uint64_t>(numbers.back() - numbers.front());
    while ((range >> shift_) > numbers.size() / numbers_a_bucket) {
      ++shift_;
    }
    begins_.assign((range >> shift_) + 2, static_cast<std::int32_t>(numbers.size()));
    for (std::size_t i = numbers.size(); i-- > 0;) {
      begins_[bucket_of(numbers[i])] = static_cast<std::int32_t>(i);
    }
    // Where a bucket is empty, the next one begins.
    for (std::size_t b = begins_.size() - 1; b-- > 0;) {
      begins_[b] = std::min(begins_[b], begins_[b + 1]);
    }
  }

  /// The place of a number that is in the list. Complexity: logarithmic in the numbers near it. Local.
  std::int32_t place_of(std::int64_t number) const {
    const std::size_t bucket = bucket_of(number);
    const auto begin = numbers_.begin() + begins_[bucket];
    const auto end = numbers_.begin() + begins_[bucket + 1];
    return static_cast<std::int32_t>(std::lower_bound(begin, end, number) - numbers_.begin());
  }

 private:
  static constexpr std::size_t numbers_a_bucket = 8;

  std::size_t bucket_of(std::int64_t number) const {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(number - numbers_.front()) >> shift_);
  }

  std::span<const std::int64_t> numbers_;
  unsigned shift_ = 0;
  std::vector<std::int32_t> begins_;  ///< of each bucket, and the end of the last
};

}  // namespace trismooth
