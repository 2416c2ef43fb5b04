// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// The range [0, size) cut into numbered blocks for the workers, for whoever has to know which block comes before
/// which: one where the range is small or there is one worker, else a few for each of them.
class Blocks {
 public:
  Blocks(std::int64_t size, std::int64_t grain, const Workers& workers)
      : size_(size),
        count_(workers.count() == 1 || size <= grain
                   ? 1
                   : std::min((size + grain - 1) / grain, std::int64_t{blocks_a_worker} * workers.count())) {}

  /// At least one.
  std::int64_t count() const { return count_; }
  /// Where block `block` begins; that of count() is the size.
  std::int64_t begin(std::int64_t block) const { return size_ / count_ * block + std::min(block, size_ % count_); }

  /// Calls body(block, begin, end) for every block, on all workers.
  template <class Body>
  void for_each(Workers& workers, const Body& body) const {
    workers.for_blocks(count_, 1, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t block = first; block < last; ++block) {
        body(block, begin(block), begin(block + 1));
      }
    });
  }

 private:
  static constexpr int blocks_a_worker = 4;

  std::int64_t size_;
  std::int64_t count_;
};

}  // namespace trismooth
