// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "trismooth/base/machine/blocks.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// The least elements for which a pass over numbers is shared out.
inline constexpr std::int64_t prefix_grain = 32768;

/// The sum of size(i) over all i before each block.
template <class Sum, class Size>
std::vector<Sum> sums_before(const Blocks& blocks, const Size& size, Workers& workers) {
  std::vector<Sum> before(static_cast<std::size_t>(blocks.count()), Sum{0});
  if (blocks.count() > 1) {
    blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      if (block + 1 < blocks.count()) {
        Sum sum{0};
        for (std::int64_t i = begin; i < end; ++i) {
          sum += static_cast<Sum>(size(i));
        }
        before[block + 1] = sum;
      }
    });
    for (std::int64_t block = 1; block < blocks.count(); ++block) {
      before[block] += before[block - 1];
    }
  }
  return before;
}

/// Writes to `sums`, which has one element more than there are sizes, how much all sizes before each element are
/// together: sums[0] = 0, sums[i + 1] = sums[i] + size(i). Calls size(i) twice for each i. Complexity: linear.
template <class Sum, class Size>
void prefix_sums(std::span<Sum> sums, const Size& size, Workers& workers) {
  const Blocks blocks(static_cast<std::int64_t>(sums.size()) - 1, prefix_grain, workers);
  const std::vector<Sum> before = sums_before<Sum>(blocks, size, workers);
  sums[0] = Sum{0};
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Sum sum = before[block];
    for (std::int64_t i = begin; i < end; ++i) {
      sum += static_cast<Sum>(size(i));
      sums[i + 1] = sum;
    }
  });
}

/// Calls visit(number, i) for every i of [0, size) for which counts(i) is true, on all workers; the number is how many
/// there are before it. Returns how many there are. Calls counts(i) twice for each i, the second time before its visit.
/// Complexity: linear.
template <class Counts, class Visit>
std::int64_t for_each_numbered(std::int64_t size, const Counts& counts, const Visit& visit, Workers& workers) {
  const Blocks blocks(size, prefix_grain, workers);
  const std::vector<std::int64_t> before = sums_before<std::int64_t>(
      blocks, [&](std::int64_t i) { return counts(i) ? 1 : 0; }, workers);
  std::int64_t found = 0;
  blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::int64_t number = before[block];
    for (std::int64_t i = begin; i < end; ++i) {
      if (counts(i)) {
        visit(number++, i);
      }
    }
    if (block + 1 == blocks.count()) {
      found = number;
    }
  });
  return found;
}

/// value(i), or i itself, for every i of [0, size) for which counts(i) is true, in their order. Calls counts(i) twice
/// for each i. Complexity: linear.
template <class Counts, class Value = std::identity>
BulkVector<std::int32_t> numbers_of(std::int64_t size, const Counts& counts, Workers& workers,
                                    const Value& value = {}) {
  BulkVector<std::int32_t> numbers(static_cast<std::size_t>(size));
  const std::int64_t count = for_each_numbered(
      size, counts, [&](std::int64_t number, std::int64_t i) { numbers[number] = static_cast<std::int32_t>(value(i)); },
      workers);
  numbers.resize(static_cast<std::size_t>(count));
  return numbers;
}

}  // namespace trismooth
