// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/machine/workers.h"

namespace trismooth {

/// The sum of term(i) for i below `count`, of numbers or of what has += : over blocks of a fixed size, which are added
/// up in their order, so it has the same bits for every number of threads. term is called once for each i, from several
/// threads.
template <class Index, class Term>
auto ordered_sum(Index count, const Term& term, Workers& workers) {
  using Sum = decltype(term(Index{}));
  constexpr std::int64_t block_size = 1024;
  std::vector<Sum> blocks(static_cast<std::size_t>((count + block_size - 1) / block_size));
  workers.for_blocks(std::ssize(blocks), 4, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t block = begin; block < end; ++block) {
      Sum sum{};
      for (std::int64_t i = block * block_size; i < std::min<std::int64_t>((block + 1) * block_size, count); ++i) {
        sum += term(static_cast<Index>(i));
      }
      blocks[block] = sum;
    }
  });
  Sum total{};
  for (const Sum& sum : blocks) {
    total += sum;
  }
  return total;
}

}  // namespace trismooth
